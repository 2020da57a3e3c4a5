// SPDX-License-Identifier: MIT
#include "solver/joints/face_nodes.hpp"

namespace tribo {

template <int Dim>
void FaceNodes<Dim>::list_fields() {
  fields_of_.resize(system_.fields.size());
  for (auto& list : fields_of_) list.clear();
  movable_.clear();
  for (std::uint32_t f = 0; f < system_.fields.size(); ++f) {
    const Field<Dim>& field = system_.fields[f];
    fields_of_[field.base_field].push_back(f);
    if (!field.rigid_contact) movable_.push_back(f);
  }
}

// Lists the masses at the nodes of the stencil of the point x. With cracks, they depend on the side of the point.
template <int Dim>
void FaceNodes<Dim>::find_masses(const Vec<Dim>& x, const Vec<Dim>& side_point,
                                 const typename NodesAround<Dim>::Stencil& stencil, Memory& memory) const {
  memory.entries.clear(), memory.range = {};
  thread_local typename Cracks<Dim>::NodeBox around;
  typename Cracks<Dim>::PointSides sides;
  if (cracks_.active()) {
    cracks_.find_nodes(x, around);
    sides = cracks_.sides_of(around, side_point);
  }
  stencil.each([&](std::size_t position, double, const Index<Dim>& node) {
    Index<Dim> inside = node;
    const Vec<Dim> mirror = nodes_around_.fold(inside);
    const int across = cracks_.active() ? cracks_.side_of_node(sides, node) : 0;
    typename Memory::Entry entry{};
    entry.position = position, entry.at = system_.lattice.position(node);
    for (int d = 0; d < Dim; ++d) entry.share.mirrored |= (mirror[d] < 0 ? 1U << d : 0U) & 0xffU;
    // the nodal mass includes the mass of the images
    const double images = std::exp2(nodes_around_.planes_through(inside));
    const std::size_t first = memory.entries.size();
    double total = 0.0;
    for (const std::uint32_t f : *memory.fields) {
      const Field<Dim>& field = system_.fields[f];
      if (field.side != across) continue;
      const auto at = field.map.node(inside);
      if (at < 0) continue;
      entry.part = field.nodes[static_cast<std::size_t>(at)].mass;
      if (!(entry.part > 0)) continue;
      total += entry.part;
      entry.share.field = f & 0xffffffU, entry.share.node = static_cast<std::uint32_t>(at);
      entry.share.mobility = field.rigid_contact ? 0.0 : images / entry.part;
      memory.entries.push_back(entry);
    }
    if (memory.entries.size() > first) memory.range.include(inside);
    for (std::size_t i = first; i < memory.entries.size(); ++i)
      memory.entries[i].part /= total, memory.entries[i].mass_of_node = total;
  });
}

template <int Dim>
double FaceNodes<Dim>::find(const JointSurface<Dim>& surface, const Vec<Dim>& x, const Vec<Dim>& n, std::size_t side,
                            Memory& memory, std::vector<NodeWeight<Dim>>& out, NodeRange<Dim>& range) const {
  out.clear();
  const double h = system_.lattice.spacing.maxCoeff(), per_cell = 1 / h;
  typename NodesAround<Dim>::Stencil stencil;
  if (!nodes_around_.find(x, stencil)) return 0.0;
  if (const auto* list = &fields(surface, side);
      cracks_.active() || memory.fields != list || !memory.stencil.has_nodes_of(stencil)) {
    const bool of_crack = surface.crack != JointSurface<Dim>::none;
    memory.fields = list, memory.stencil = stencil;
    find_masses(x, of_crack ? Vec<Dim>(x + (side == 0 ? -1e-6 : 1e-6) * h * n) : x, stencil, memory);
  }
  std::array<double, NodesAround<Dim>::Stencil::size> weights;
  stencil.each([&](std::size_t position, double weight, const Index<Dim>&) { weights[position] = weight; });
  std::vector<FitNode<Dim>>& nodes = memory.fit;
  nodes.clear();
  double shapes = 0.0, mass = 0.0;
  std::size_t last = weights.size();
  for (const auto& entry : memory.entries) {
    const double weight = weights[entry.position];
    if (!(weight > 0)) continue;
    if (entry.position != last) shapes += weight, mass += weight * entry.mass_of_node, last = entry.position;
    out.push_back(entry.share);
    nodes.push_back({per_cell * (entry.at - x), weight * entry.part, entry.mass_of_node});
  }
  if (!(mass > 0)) return 0.0;
  range.include(memory.range.low), range.include(memory.range.high);
  for (FitNode<Dim>& node : nodes) node.mass *= shapes / mass;
  constexpr double aligned = 1 - 1e-5;  // 0.26 degrees
  Eigen::Index axis = 0;
  if (surface.interface)
    fit_face_velocity(nodes, light_at_interfaces);
  else if (n.cwiseAbs().maxCoeff(&axis) > aligned)
    fit_aligned_face_velocity(nodes, static_cast<int>(axis));
  else
    fit_face_velocity(nodes, light_at_joints);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].weight = nodes[i].weight, out[i].slope = per_cell * nodes[i].slope;
  return mass;
}

template class FaceNodes<2>;
template class FaceNodes<3>;

}  // namespace tribo
