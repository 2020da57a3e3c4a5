// SPDX-License-Identifier: MIT
#include "solver/impulse_choice.hpp"

#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "materials/material.hpp"
#include "particles/voxels.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace tribo {
namespace {

constexpr double thin = 3.0;  // cells
// With more deformable bodies than this, the iteration over all faces takes most of the time.
constexpr std::ptrdiff_t many = 16;
constexpr double tolerance = 0.25;  // of the thickness measured, for plates at an angle to the grid [cells]

const MaterialSpec& spec(const Model& model, int material) {
  return model.materials[static_cast<std::size_t>(material)];
}

// The material to which the velocity field of a material belongs.
int owner(const Model& model, int material) {
  const int with = spec(model, material).share_field_with;
  return with >= 0 ? with : material;
}

// Calls f(law) for all pairs of a material with another velocity field.
template <class F>
void each_law(const Model& model, const std::set<int>& materials, int of, F&& f) {
  for (const int other : materials)
    if (owner(model, other) != owner(model, of))
      if (const ContactLaw* law = model.contact.law(of, other)) f(*law);
}

// The setting of the command file that is meant for impulses on nodes; empty: none.
std::string setting_for_nodes(const Model& model) {
  if (model.contact.normals != NormalMethod::margin) return "the command file sets the method for normals";
  if (model.contact.separation != Separation::edges) return "the command file sets the method for gaps";
  return "";
}

// What makes nodes the better place unless a body is thin or lies between rigid faces; empty: nothing.
std::string advantage_of_nodes(const Model& model, const std::set<int>& materials) {
  if (!model.cracks.empty()) return "the model has cracks";
  if (!model.contact.joints.empty()) return "the model has joints";
  bool interfaces = false, films = false;
  for (const int k : materials)
    each_law(model, materials, k,
             [&](const ContactLaw& law) { interfaces |= law.interface() != nullptr, films |= law.liquid() != 0; });
  if (interfaces) return "the model has interfaces";
  // Between faces that a film keeps apart only impulses on nodes conserve the angular momentum exactly.
  return films ? "the model has films of liquid" : "";
}

// Whether two bodies touch without a joint or an interface between them, which have stiffnesses of their own.
bool has_contact_at_faces(const Model& model, int a, int b) {
  const ContactLaw* law = model.contact.law(a, b);
  return law && law->uses_face() && !law->interface() &&
         !model.contact.joints.contains({std::min(a, b), std::max(a, b)});
}

// The cubes of each velocity field whose laws act at faces, by the owner of the field.
template <int Dim>
std::map<int, Voxels<Dim>> bodies_in_contact(const Model& model, const Seeds& seeds, const Lattice<Dim>& lattice,
                                             const std::set<int>& materials) {
  std::map<int, Voxels<Dim>> bodies;
  for (const int k : materials) {
    bool faces = false;
    each_law(model, materials, k, [&](const ContactLaw& law) { faces = faces || law.uses_face(); });
    if (faces) bodies.try_emplace(owner(model, k), model, lattice);
  }
  for (const Seed& seed : seeds)
    if (const auto found = bodies.find(owner(model, seed.material)); found != bodies.end()) found->second.add(seed);
  for (auto& entry : bodies) entry.second.sort();
  return bodies;
}

// For each body the others that may touch it: those whose bounding boxes overlap its own, with a margin. They are found
// by a sweep along the first axis.
template <int Dim>
std::map<int, std::set<int>> near_bodies(const std::map<int, Voxels<Dim>>& bodies) {
  using Box = typename Voxels<Dim>::Box;
  std::vector<std::pair<Box, int>> boxes;
  std::map<int, std::set<int>> near;
  for (const auto& [material, cubes] : bodies) {
    near[material];
    if (!cubes.empty()) boxes.emplace_back(cubes.box(), material);
  }
  std::sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.low[0], a.second) < std::pair(b.first.low[0], b.second);
  });
  for (auto a = boxes.begin(); a != boxes.end(); ++a)
    for (auto b = a + 1; b != boxes.end() && b->first.low[0] <= a->first.high[0] + Voxels<Dim>::margin; ++b) {
      bool touch = true;
      for (std::size_t d = 0; d < Dim; ++d)
        touch = touch && b->first.low[d] <= a->first.high[d] + Voxels<Dim>::margin &&
                a->first.low[d] <= b->first.high[d] + Voxels<Dim>::margin;
      if (touch) near[a->second].insert(b->second), near[b->second].insert(a->second);
    }
  return near;
}

// The cubes of the bodies that a body may touch, or of the rigid ones among them.
template <int Dim>
Voxels<Dim> neighbours(const Model& model, const Lattice<Dim>& lattice, const std::map<int, Voxels<Dim>>& bodies,
                       const std::pair<const int, std::set<int>>& near, bool only_rigid) {
  Voxels<Dim> others(model, lattice);
  for (const int other : near.second)
    if (has_contact_at_faces(model, near.first, other) && (!only_rigid || spec(model, other).law->rigid()))
      others.add(bodies.at(other));
  others.sort();
  return others;
}

// The body that is too stiff with impulses on nodes, and why; empty: none.
template <int Dim>
std::string need(const Model& model, const Lattice<Dim>& lattice, const std::map<int, Voxels<Dim>>& bodies,
                 const std::map<int, std::set<int>>& near) {
  for (const auto& entry : near) {
    const MaterialSpec& material = spec(model, entry.first);
    if (material.law->rigid()) continue;
    const auto cells = bodies.at(entry.first).thickness_behind(neighbours(model, lattice, bodies, entry, false));
    if (cells && *cells <= thin + tolerance) return "'" + material.name + "' is " + counted(*cells, "cell") + " thick";
  }
  for (const auto& entry : near) {
    const MaterialSpec& material = spec(model, entry.first);
    if (!material.law->rigid() && bodies.at(entry.first).lies_between(neighbours(model, lattice, bodies, entry, true)))
      return "'" + material.name + "' lies between rigid faces on opposite sides";
  }
  return "";
}

// Whether a deformable body touches a rigid one.
bool touches_rigid_body(const Model& model, const std::map<int, std::set<int>>& near) {
  const auto is_rigid = [&](int k) { return spec(model, k).law->rigid(); };
  return std::any_of(near.begin(), near.end(), [&](const auto& body) {
    return !is_rigid(body.first) && std::any_of(body.second.begin(), body.second.end(), is_rigid);
  });
}

bool has_splines(const Model& model) {
  return model.scheme.kernel == Kernel::quadratic_spline || model.scheme.kernel == Kernel::cubic_spline;
}

// What is to be said of stresses next to rigid faces with impulses on nodes; empty: nothing.
std::string warning_of_splines(const Model& model, const std::map<int, std::set<int>>& near) {
  if (!has_splines(model) || !touches_rigid_body(model, near)) return "";
  return ". With splines, stresses within two cells of a rigid face are then wrong by up to their own size: "
         "Impulses='faces' or <GIMP type='uGIMP'/> where they matter";
}

// What is to be said of elastic bodies that slide with friction, which impulses on nodes damp; empty: nothing.
std::string remark_on_vibrations(const Model& model) {
  const Transfer transfer = model.scheme.transfer;
  if (model.seeks_equilibrium() || (transfer != Transfer::flip && transfer != Transfer::apic)) return "";
  return ". Without damping, elastic bodies vibrate while they slide with friction: <Transfer type='FMPM' order='2'/> "
         "or Impulses='nodes' prevents that";
}

// What makes faces more accurate, if they do not take too long: friction on a curved surface acts at the surface, and
// material that has opened is pressed again. With splines, impulses on nodes would act on a layer of three rows of
// nodes, so that a body that tips over turns about a point far inside. Inelastic materials damp themselves; elastic
// blocks that slide vibrate less with impulses on nodes. Empty: nothing.
template <int Dim>
std::string advantage(const Model& model, const std::set<int>& materials, const std::map<int, Voxels<Dim>>& bodies) {
  const auto in_contact = [&](int material) { return material >= 0 && bodies.contains(owner(model, material)); };
  for (const Piece& piece : model.pieces)
    if (in_contact(piece.material) && piece.curved()) return "'" + spec(model, piece.material).name + "' is curved";
  for (const int k : materials)
    if (in_contact(k) && spec(model, k).law->dissipation_index() >= 0)
      return "'" + spec(model, k).name + "' is inelastic";
  return has_splines(model)
             ? "splines would spread impulses on nodes over three rows of nodes" + remark_on_vibrations(model)
             : "";
}

// Whether a disc or a ball among the blocks may touch bodies in the grid.
bool has_curved_block(const Model& model) {
  const auto& groups = model.blocks->groups;
  return std::any_of(groups.begin(), groups.end(), [](const BlockGroup& group) {
    return group.shape == BlockGroup::Shape::ball && group.material >= 0;
  });
}

template <int Dim>
std::ptrdiff_t count_deformable(const Model& model, const std::map<int, Voxels<Dim>>& bodies) {
  return std::count_if(bodies.begin(), bodies.end(),
                       [&](const auto& body) { return !spec(model, body.first).law->rigid(); });
}

}  // namespace

template <int Dim>
ImpulseChoice choose_impulses(const Model& model, const Seeds& seeds, const Lattice<Dim>& lattice) {
  if (!model.contact.active) return {};
  if (const auto given = model.contact.at_faces)
    return {*given, *given ? "on faces, as the command file says" : "on nodes, as the command file says"};
  std::set<int> materials;  // that have a velocity field
  for (const Seed& seed : seeds) {
    const MaterialSpec& material = spec(model, seed.material);
    if (!material.law->rigid() || material.touches()) materials.insert(seed.material);
  }
  const std::string setting = setting_for_nodes(model), nodes = advantage_of_nodes(model, materials);
  if (model.blocks) {
    if (const std::string& why = setting.empty() ? nodes : setting; !why.empty())
      return {false, "on nodes, because " + why};
    if (has_curved_block(model)) return {true, "on faces, because a block is curved"};
    return {false, "on nodes, because no rigid block is curved"};
  }
  const auto bodies = bodies_in_contact(model, seeds, lattice, materials);
  if (bodies.empty()) return {false, "on nodes, because no contact law acts between faces"};
  const auto near = near_bodies(bodies);
  const std::string wanted = need(model, lattice, bodies, near), splines = warning_of_splines(model, near);
  if (!setting.empty())
    return {false, "on nodes, because " + setting +
                       (wanted.empty() ? splines : ", although " + wanted + ", " + faces_may_be_better)};
  if (!wanted.empty()) return {true, "on faces, because " + wanted};
  if (!nodes.empty()) return {false, "on nodes, because " + nodes + splines};
  const std::string better = advantage(model, materials, bodies);
  if (better.empty())
    return {false,
            "on nodes, because no body in contact is thin, curved or inelastic, or lies between rigid faces" + splines};
  const std::ptrdiff_t deformable = count_deformable(model, bodies);
  if (deformable <= many) return {true, "on faces, because " + better};
  return {false, "on nodes, because with " + counted(deformable, "deformable material") +
                     " in contact the iteration over faces would take most of the time; Impulses='faces' is more "
                     "accurate" +
                     splines};
}

template ImpulseChoice choose_impulses<2>(const Model&, const Seeds&, const Lattice<2>&);
template ImpulseChoice choose_impulses<3>(const Model&, const Seeds&, const Lattice<3>&);

}  // namespace tribo
