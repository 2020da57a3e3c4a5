// SPDX-License-Identifier: MIT
#include "solver/joints/interface_faces.hpp"

#include "contact/interface_joint.hpp"
#include "solver/joints/joint_build.hpp"
#include "solver/state/limited_interface.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <unordered_set>

namespace tribo {
namespace {

// Faces that touch at a larger angle meet at an edge, which has no area.
constexpr double largest_angle = std::numbers::pi / 3;
// Faces within a twentieth of a cell touch, so that two bodies cannot pass this range between two searches.
constexpr double longest_travel = 0.02;  // cells

template <int Dim>
std::vector<Body<Dim>*> bodies_in_contact(System<Dim>& system) {
  std::vector<Body<Dim>*> out;
  for (auto* list : {&system.bodies, &system.rigids})
    for (auto& body : *list)
      if (body.field != Body<Dim>::no_field) out.push_back(&body);
  return out;
}

template <int Dim>
Body<Dim>& body_of(System<Dim>& system, std::size_t field, int material) {
  for (auto* body : bodies_in_contact(system))
    if (body->field == field && body->material == material) return *body;
  throw std::logic_error("an interface without its body");
}

}  // namespace

template <int Dim>
void add_imperfect_interfaces(const Model& model, System<Dim>& system) {
  if (!model.contact.active) return;
  const auto bodies = bodies_in_contact(system);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      Body<Dim>&a = *bodies[i], &b = *bodies[j];
      const int first = std::min(a.material, b.material), second = std::max(a.material, b.material);
      if (a.field == b.field || (a.law->rigid() && b.law->rigid()) || model.contact.joints.contains({first, second}))
        continue;
      const ContactLaw* law = model.contact.law(first, second);
      if (!law || !law->interface()) continue;
      const auto limited =
          limited_interface(model, system.lattice, *law->interface(), std::array{a.material, b.material});
      if (!limited->is_elastic()) continue;
      const Origin& origin = model.materials[static_cast<std::size_t>(first)].origin;
      if (a.block >= 0 || b.block >= 0)
        throw InputError(origin, "an imperfect interface between '" + a.name + "' and '" + b.name +
                                     "' is not implemented, since one of them is a block: take a joint law");
      if (model.splitting)
        throw InputError(origin, "an imperfect interface between '" + a.name + "' and '" + b.name +
                                     "' is not implemented for particles that split: leave out <SplitParticles>");
      JointSurface<Dim> surface;
      surface.interface = std::make_shared<InterfaceJoint>(limited), surface.law = surface.interface.get();
      surface.field = {a.field, b.field}, surface.material = {a.material, b.material};
      system.joints.push_back(std::move(surface));
    }
}

template <int Dim>
InterfaceFaces<Dim>::InterfaceFaces(const Model& model, System<Dim>& system)
    : model_(model),
      system_(system),
      any_(std::any_of(system.joints.begin(), system.joints.end(),
                       [](const auto& surface) { return surface.interface && surface.crack == surface.none; })),
      travel_(std::numeric_limits<double>::max()) {}

template <int Dim>
void InterfaceFaces<Dim>::find() {
  if (!any_) return;
  const bool due = travel_ >= longest_travel;
  if (due) travel_ = 0.0;
  for (auto& surface : system_.joints) {
    if (!surface.interface || surface.crack != surface.none) continue;
    if (due) remove_detached(surface);
    surface.deforming = surface.joints.size();
    if (!due) continue;
    add_joints(surface);
  }
}

template <int Dim>
void InterfaceFaces<Dim>::remove_detached(JointSurface<Dim>& surface) {
  std::vector<char> attached(surface.joints.size(), 0);
  for (std::size_t s = 0; s < surface.samples.size(); ++s)
    if (surface.mass[0][s] != surface.detached) attached[surface.samples[s].joint[0]] = 1;
  if (std::all_of(attached.begin(), attached.end(), [](char is) { return is != 0; })) return;
  std::vector<std::uint32_t> number(surface.joints.size());
  std::size_t joints = 0, samples = 0;
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    if (!attached[k]) {
      surface.dissipated += surface.joints[k].released() + surface.joints[k].strain;
      continue;
    }
    number[k] = static_cast<std::uint32_t>(joints);
    surface.joints[joints] = surface.joints[k], surface.x[joints] = surface.x[k];
    surface.axes[joints] = surface.axes[k], surface.side[joints] = surface.side[k];
    ++joints;
  }
  for (std::size_t s = 0; s < surface.samples.size(); ++s) {
    if (!attached[surface.samples[s].joint[0]]) continue;
    surface.samples[samples] = surface.samples[s];
    surface.samples[samples].joint[0] = number[surface.samples[s].joint[0]];
    for (auto& mass : surface.mass) mass[samples] = mass[s];
    ++samples;
  }
  surface.joints.resize(joints), surface.x.resize(joints), surface.axes.resize(joints), surface.side.resize(joints);
  surface.samples.resize(samples);
  for (auto& mass : surface.mass) mass.resize(samples);
}

template <int Dim>
void InterfaceFaces<Dim>::add_joints(JointSurface<Dim>& surface) {
  Body<Dim>&one = body_of(system_, surface.field[0], surface.material[0]),
  &two = body_of(system_, surface.field[1], surface.material[1]);
  auto pieces = common_face_pieces(model_, system_, one, two, largest_angle);
  if (pieces.empty()) return;
  smooth_steps(system_.lattice, pieces);
  const std::unordered_set<std::int64_t> joined(surface.side.begin(), surface.side.end());
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    while (end < pieces.size() && pieces[end].side_number == pieces[begin].side_number) ++end;
    if (joined.contains(pieces[begin].side)) continue;
    add_joint(pieces, begin, end, model_.grid.thickness, surface);
    surface.side.push_back(pieces[begin].side);
  }
  for (auto& mass : surface.mass) mass.resize(surface.samples.size(), 0.0);
}

template void add_imperfect_interfaces(const Model&, System<2>&);
template void add_imperfect_interfaces(const Model&, System<3>&);
template class InterfaceFaces<2>;
template class InterfaceFaces<3>;

}  // namespace tribo
