// SPDX-License-Identifier: MIT
#include "run/held_bodies.hpp"

#include "base/text.hpp"
#include "grid/select.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tribo {
namespace {

template <int Dim>
using MaterialsAtNodes = std::map<Index<Dim>, std::set<int>>;

// The nodes that conditions fix in all directions, each without materials.
template <int Dim>
MaterialsAtNodes<Dim> fixed_nodes(const Model& model, const System<Dim>& system) {
  std::map<Index<Dim>, std::set<int>> directions;
  for (const auto& c : model.node_conditions)
    each_node_in<Dim>(system.lattice, *c.where, [&](const Index<Dim>& node) {
      for (int d = 0; d < Dim; ++d)
        if (c.direction[d] != 0) directions[node].insert(d);
    });
  MaterialsAtNodes<Dim> out;
  for (const auto& [node, fixed] : directions)
    if (fixed.size() == Dim) out[node];
  return out;
}

// Adds the materials of the particles to which a node is the nearest.
template <int Dim>
void add_materials(MaterialsAtNodes<Dim>& nodes, const Lattice<Dim>& lattice, const Seeds& seeds) {
  for (const Seed& s : seeds) {
    Index<Dim> node{};
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      node[d] = static_cast<int>(std::lround((s.x[k] - lattice.origin[k]) / lattice.spacing[k]));
    }
    if (const auto found = nodes.find(node); found != nodes.end()) found->second.insert(s.material);
  }
}

template <int Dim>
void held_by_nodes(const Model& model, const System<Dim>& system, const Seeds& seeds, Remarks& out) {
  if (!model.contact.active || model.node_conditions.empty()) return;
  const auto name = [&](int k) { return "'" + model.materials[static_cast<std::size_t>(k)].name + "'"; };
  auto nodes = fixed_nodes(model, system);
  add_materials(nodes, system.lattice, seeds);
  std::set<int> held;
  std::set<std::pair<int, int>> meeting;
  for (const auto& [node, materials] : nodes)
    for (const int k : materials) {
      if (!model.materials[static_cast<std::size_t>(k)].law->rigid()) held.insert(k);
      for (const int other : materials)
        if (k < other) meeting.insert({k, other});
    }
  for (const int k : held)
    out.lines.push_back("held: " + name(k) + " by nodes that are fixed in all directions, where it cannot slide");
  for (const auto& pair : meeting)
    out.advice.push_back(
        name(pair.first) + " and " + name(pair.second) +
        " meet at nodes that are fixed in all directions: no law of contact acts there. If they should "
        "slide, take a RigidContact body, or fix only the normal direction");
}

// Whether anything could stop a body that falls.
bool anything_holds(const Model& model) {
  const GridSpec& grid = model.grid;
  const auto any = [](const auto& planes) { return planes[0] || planes[1]; };
  return !model.node_conditions.empty() || !model.particle_conditions.empty() || model.blocks ||
         !model.stages.empty() || std::any_of(grid.symmetry.begin(), grid.symmetry.end(), any) ||
         std::any_of(grid.wall.begin(), grid.wall.end(), any) ||
         std::any_of(grid.periodic.begin(), grid.periodic.end(), [](bool periodic) { return periodic; }) ||
         std::any_of(model.materials.begin(), model.materials.end(),
                     [](const MaterialSpec& m) { return m.law && m.law->rigid(); });
}

}  // namespace

template <int Dim>
Remarks describe_holds(const Model& model, const System<Dim>& system, const Seeds& seeds) {
  Remarks out;
  held_by_nodes(model, system, seeds, out);
  if (!model.body_force.gravity.isZero() && !anything_holds(model))
    out.advice.emplace_back(
        "gravity acts, but nothing holds the bodies: there is no condition, wall, plane of symmetry or rigid body, so "
        "that all of them fall freely");
  return out;
}

template Remarks describe_holds(const Model&, const System<2>&, const Seeds&);
template Remarks describe_holds(const Model&, const System<3>&, const Seeds&);

}  // namespace tribo
