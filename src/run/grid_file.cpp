// SPDX-License-Identifier: MIT
#include "run/grid_file.hpp"

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

template <int Dim>
GridFile::GridFile(const Model& model, const System<Dim>& system) : time_(system.time) {
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
        const GridNodeState state = grid_node_state(system, n);
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
template GridFile::GridFile(const Model&, const System<2>&);
template GridFile::GridFile(const Model&, const System<3>&);

}  // namespace tribo
