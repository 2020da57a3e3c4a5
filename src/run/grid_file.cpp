// SPDX-License-Identifier: MIT
#include "run/grid_file.hpp"

#include "base/bytes.hpp"
#include "base/ranks.hpp"

#include <unordered_set>

namespace tribo {
// The velocity of a single field is taken as it is: its product with the mass, divided by the mass, would round.
template <int Dim>
GridNodeState grid_node_state(const System<Dim>& system, const Index<Dim>& node) {
  GridNodeState out;
  Vec3 momentum = Vec3::Zero();
  int fields = 0;
  for (const Field<Dim>& field : system.fields) {
    const auto position = field.map.node(node);
    if (position < 0 || field.nodes.empty()) continue;
    const Node& n = field.nodes[static_cast<std::size_t>(position)];
    if (!(n.mass > 0)) continue;
    Vec3 velocity = Vec3::Zero();
    for (int d = 0; d < Dim; ++d) velocity[d] = n.velocity[d];
    out.mass += n.mass, momentum += n.mass * velocity;
    if (++fields == 1) out.velocity = velocity;
  }
  if (fields > 1) out.velocity = momentum / out.mass;
  return out;
}

namespace {

template <int Dim>
std::int64_t number_of(const Lattice<Dim>& lattice, const Index<Dim>& node) {
  std::int64_t number = 0;
  for (std::size_t d = Dim; d-- > 0;) number = number * lattice.blocks[d] * block_edge<Dim> + node[d];
  return number;
}

// A node in a message.
struct SentNode {
  std::int64_t number;
  double mass;
  std::array<double, 3> velocity;
};

}  // namespace

template <int Dim>
GridNodes collect_grid_nodes(const System<Dim>& system) {
  std::unordered_set<std::int64_t> blocks;
  for (const Field<Dim>& field : system.fields)
    for (std::size_t slot = 0; slot < field.map.active().size(); ++slot)
      if (field.map.is_own(slot)) blocks.insert(field.map.active()[slot]);
  ByteWriter own;
  for (const std::int64_t block : blocks) {
    Index<Dim> low = system.lattice.block_at(block), high;
    for (std::size_t d = 0; d < Dim; ++d) low[d] *= block_edge<Dim>, high[d] = low[d] + block_edge<Dim> - 1;
    each_in_box<Dim>(low, high, [&](const Index<Dim>& node) {
      const GridNodeState state = grid_node_state(system, node);
      if (!(state.mass > 0)) return;
      own.value(SentNode{
          number_of(system.lattice, node), state.mass, {state.velocity[0], state.velocity[1], state.velocity[2]}});
    });
  }
  GridNodes out;
  for (const auto& message : ranks().gather(std::move(own.data)))
    for (ByteReader reader(message); !reader.at_end();) {
      const auto node = reader.value<SentNode>();
      GridNodeState& state = out[node.number];
      state.mass = node.mass, state.velocity = Vec3(node.velocity[0], node.velocity[1], node.velocity[2]);
    }
  return out;
}

template <int Dim>
GridFile::GridFile(const Model& model, const System<Dim>& system, const GridNodes* collected) : time_(system.time) {
  for (std::size_t d = 0; d < Dim; ++d) {
    origin_[d] = model.grid.low[d];
    spacing_[d] = system.lattice.spacing[static_cast<Eigen::Index>(d)];
    nodes_[d] = model.grid.cells[d] + 1;
    count_ *= static_cast<std::size_t>(nodes_[d]);
  }
  for (const auto& name : model.output.grid_fields) {
    const GridField* field = find_grid_field(name);
    columns_.push_back({field, {field->components, std::vector<double>(count_, 0.0)}});
  }
  std::size_t at = 0;
  for (int k = 0; k < nodes_[2]; ++k)
    for (int j = 0; j < nodes_[1]; ++j)
      for (int i = 0; i < nodes_[0]; ++i, ++at) {
        Index<Dim> n{};
        n[0] = i + Lattice<Dim>::padding, n[1] = j + Lattice<Dim>::padding;
        if constexpr (Dim == 3) n[2] = k + Lattice<Dim>::padding;
        GridNodeState state;
        if (!collected)
          state = grid_node_state(system, n);
        else if (const auto found = collected->find(number_of(system.lattice, n)); found != collected->end())
          state = found->second;
        for (Column& column : columns_) {
          std::array<double, 3> values{};
          column.field->value(state, values.data());
          for (std::size_t c = 0; c < column.components.size(); ++c) column.components[c][at] = values[c];
        }
      }
  check_numbers(count_, {}, fields());
}

std::vector<OutputField> GridFile::fields() const {
  std::vector<OutputField> out;
  for (const Column& column : columns_) {
    out.push_back({std::string(column.field->name), {}, nullptr});
    for (const auto& component : column.components) out.back().components.push_back(component.data());
  }
  return out;
}

void GridFile::write(const std::filesystem::path& path) const {
  write_grid(path, origin_, spacing_, nodes_, fields(), time_);
}

std::size_t GridFile::bytes() const {
  std::size_t sum = 0;
  for (const Column& column : columns_) sum += column.components.size() * count_ * sizeof(double);
  return sum;
}

template GridNodeState grid_node_state<2>(const System<2>&, const Index<2>&);
template GridNodeState grid_node_state<3>(const System<3>&, const Index<3>&);
template GridNodes collect_grid_nodes(const System<2>&);
template GridNodes collect_grid_nodes(const System<3>&);
template GridFile::GridFile(const Model&, const System<2>&, const GridNodes*);
template GridFile::GridFile(const Model&, const System<3>&, const GridNodes*);

}  // namespace tribo
