// SPDX-License-Identifier: MIT
#include "run/grid_file.hpp"

#include "output/vtk.hpp"

#include <array>
#include <vector>

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
void write_grid_file(const std::filesystem::path& path, const Model& model, const System<Dim>& system) {
  const auto& lattice = system.lattice;
  std::array<double, 3> origin{}, spacing{1, 1, 1};
  std::array<int, 3> nodes{1, 1, 1};
  std::size_t count = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    origin[d] = model.grid.low[d];
    spacing[d] = lattice.spacing[static_cast<Eigen::Index>(d)];
    nodes[d] = model.grid.cells[d] + 1;
    count *= static_cast<std::size_t>(nodes[d]);
  }
  struct Column {
    const GridField* field;
    std::vector<std::vector<double>> components;
  };
  std::vector<Column> columns;
  for (const auto& name : model.output.grid_fields) {
    const GridField* field = find_grid_field(name);
    columns.push_back({field, {field->components, std::vector<double>(count, 0.0)}});
  }
  std::size_t at = 0;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i, ++at) {
        Index<Dim> n{};
        n[0] = i + Lattice<Dim>::padding, n[1] = j + Lattice<Dim>::padding;
        if constexpr (Dim == 3) n[2] = k + Lattice<Dim>::padding;
        const GridNodeState state = grid_node_state(system, n);
        for (Column& column : columns) {
          std::array<double, 3> values{};
          column.field->value(state, values.data());
          for (std::size_t c = 0; c < column.components.size(); ++c) column.components[c][at] = values[c];
        }
      }
  std::vector<OutputField> fields;
  for (const Column& column : columns) {
    fields.push_back({std::string(column.field->name), {}, nullptr});
    for (const auto& component : column.components) fields.back().components.push_back(component.data());
  }
  tribo::write_grid(path, origin, spacing, nodes, fields, system.time);
}

template GridNodeState grid_node_state<2>(const System<2>&, const Index<2>&);
template GridNodeState grid_node_state<3>(const System<3>&, const Index<3>&);
template void write_grid_file<2>(const std::filesystem::path&, const Model&, const System<2>&);
template void write_grid_file<3>(const std::filesystem::path&, const Model&, const System<3>&);

}  // namespace tribo
