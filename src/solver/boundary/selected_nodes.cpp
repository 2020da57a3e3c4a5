// SPDX-License-Identifier: MIT
#include "solver/boundary/selected_nodes.hpp"

#include "grid/select.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace tribo {

template <int Dim>
SelectedNodes<Dim>::SelectedNodes(const Model& model, const Lattice<Dim>& lattice, Problems& problems) {
  select(model, lattice, problems);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Index<Dim> block;
    for (std::size_t d = 0; d < Dim; ++d) block[d] = nodes_[k].node[d] / block_edge<Dim>;
    by_block_.push_back({lattice.block_index(block), k});
  }
  std::ranges::stable_sort(by_block_, {}, &InBlock::block);
}

// Conditions on the same node in the same direction add.
template <int Dim>
void SelectedNodes<Dim>::select(const Model& model, const Lattice<Dim>& lattice, Problems& problems) {
  // Whether a node belongs to the grid of the model or to the layer of nodes around it
  const auto near_grid = [&](const Index<Dim>& node) {
    for (std::size_t d = 0; d < Dim; ++d)
      if (const int n = node[d] - Lattice<Dim>::padding; n < -1 || n > model.grid.cells[d] + 1) return false;
    return true;
  };
  std::map<std::pair<std::int64_t, std::array<double, 3>>, std::size_t> known;
  for (std::size_t c = 0; c < model.node_conditions.size(); ++c) {
    const auto& condition = model.node_conditions[c];
    if (condition.wall) continue;
    bool any = false;
    each_node_in<Dim>(lattice, *condition.where, [&](const Index<Dim>& node) {
      any = any || near_grid(node);
      std::int64_t flat = 0;
      for (std::size_t d = Dim; d-- > 0;) flat = flat * lattice.blocks[d] * block_edge<Dim> + node[d];
      const auto& n = condition.direction;
      const auto [entry, is_new] = known.try_emplace({flat, {n[0], n[1], n[2]}}, nodes_.size());
      if (is_new) nodes_.push_back({node, n.template head<Dim>(), {}});
      nodes_[entry->second].conditions.push_back(c);
    });
    if (!any) problems.add(condition.origin, "this condition selects no node of the grid");
  }
}

template <int Dim>
void SelectedNodes<Dim>::find(const BlockMap<Dim>& map, std::vector<Existing>& existing) const {
  existing.clear();
  for (const std::int64_t block : map.active())
    for (auto in = std::ranges::lower_bound(by_block_, block, {}, &InBlock::block);
         in != by_block_.end() && in->block == block; ++in)
      existing.push_back({in->number, map.node(nodes_[in->number].node)});
  std::ranges::sort(existing, {}, &Existing::number);
}

template class SelectedNodes<2>;
template class SelectedNodes<3>;

}  // namespace tribo
