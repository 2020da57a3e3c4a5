// SPDX-License-Identifier: MIT
#include "solver/contact/nodal_volumes.hpp"

#include "base/parallel.hpp"

#include <algorithm>

namespace tribo {

// Marks the blocks whose bins hold particles with a node in their stencil whose faces must be found, and the blocks
// whose nodes these particles reach.
template <int Dim>
void NodalVolumes<Dim>::mark_blocks(const ContactNodes<Dim>& contacts) {
  const auto& lattice = system_.lattice;
  near_.assign(static_cast<std::size_t>(lattice.block_count()), 0), reached_ = near_;
  for (const auto& node : contacts.nodes) {
    if (!node.needs_faces) continue;
    // A stencil that contains the node begins at most three nodes below it. One more cell is added for the drift of
    // the particles since the last sort.
    Index<Dim> low, high;
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = std::max(0, (node.index[d] - 5) / block_edge<Dim>);
      high[d] = std::min(lattice.blocks[d] - 1, (node.index[d] + 1) / block_edge<Dim>);
    }
    const auto mark = [&](std::vector<char>& blocks) {
      each_in_box<Dim>(low, high, [&](const Index<Dim>& block) {
        blocks[static_cast<std::size_t>(lattice.block_index(block))] = 1;
      });
    };
    mark(near_);
    // Particles reach nodes of the next blocks, too.
    for (std::size_t d = 0; d < Dim; ++d)
      low[d] = std::max(0, low[d] - 1), high[d] = std::min(lattice.blocks[d] - 1, high[d] + 1);
    mark(reached_);
  }
}

template <int Dim>
void NodalVolumes<Dim>::scatter(const ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies,
                                const Exchanges<Dim>& exchanges) {
  mark_blocks(contacts);
  const auto count = static_cast<std::ptrdiff_t>(system_.fields.size());
  parallel_for(count, [&](std::ptrdiff_t f) {
    auto& field = system_.fields[static_cast<std::size_t>(f)];
    field.volumes.resize(field.nodes.size());
    const auto& active = field.map.active();
    for (std::size_t slot = 0; slot < active.size(); ++slot)
      if (reached_[static_cast<std::size_t>(active[slot])] != 0)
        std::fill_n(&field.volumes[slot * block_nodes<Dim>], block_nodes<Dim>, VolumeNode{});
  });
  // Bodies of different fields have different nodes. Where there are many fields, each thread takes whole fields, else
  // the threads share the particles of each body.
  constexpr std::ptrdiff_t fields_per_thread = 4;
  bodies_of_.resize(system_.fields.size());
  for (auto& list : bodies_of_) list.clear();
  for (auto* body : bodies) bodies_of_[body->field].push_back(body);
  parallel_for(
      count,
      [&](std::ptrdiff_t f) {
        for (auto* body : bodies_of_[static_cast<std::size_t>(f)])
          transfers_.scatter(*body, Target<Dim>(*body, system_.fields, &Field<Dim>::volumes), Scatter::volume, false,
                             system_.analysis == Analysis::axisymmetric, &near_);
      },
      fields_per_thread * threads());
  for (std::size_t f = 0; f < system_.fields.size(); ++f) exchanges[f]->sum_images(system_.fields[f].volumes);
}

template class NodalVolumes<2>;
template class NodalVolumes<3>;

}  // namespace tribo
