// SPDX-License-Identifier: MIT
/// The laws of contacts that form during the run.

#include "blocks/assembly.hpp"

#include <algorithm>

namespace tribo {

void Assembly::list_later_laws() {
  const auto add = [&](const JointLaw* law) {
    if (law && std::find(later_laws_.begin(), later_laws_.end(), law) == later_laws_.end()) later_laws_.push_back(law);
  };
  for (std::size_t k = 0; k <= spec_->joints.size(); ++k) {
    if (k < spec_->joints.size() && !spec_->joints[k].later) continue;
    const BlockLaws& laws = spec_->laws_of(k);
    add(laws.later.get());
    for (const auto& of_two : laws.by_groups) add(of_two.second[1].get());
  }
}

BlockPairing Assembly::pairing(std::uint32_t a, std::uint32_t b, ContactKind kind, const Vec3& place,
                               const Vec3& normal, bool later) const {
  BlockPairing out;
  out.groups = {bodies[a].group, bodies[b].group};
  out.place = place, out.normal = normal, out.later = later;
  out.kind = kind == ContactKind::ball           ? BlockPairing::Kind::balls
             : kind == ContactKind::ball_on_face ? BlockPairing::Kind::ball_on_face
                                                 : BlockPairing::Kind::faces;
  return out;
}

BlockPairing Assembly::pairing_of(std::size_t k, ContactKind kind) const {
  return pairing(contacts[k].a, contacts[k].b, kind, contact_forces[k].at, contacts[k].axes.n, false);
}

// The place of a contact that has not formed yet is between the nearest points of the two blocks to their centres.
std::optional<std::uint32_t> Assembly::later_law(std::uint32_t a, std::uint32_t b) const {
  std::size_t rule = spec_->joints.size();
  if (std::any_of(spec_->joints.begin(), spec_->joints.end(), [](const BlockJoint& j) { return j.later; })) {
    const bool balls = shapes[a].ball() && shapes[b].ball(), faces = !shapes[a].ball() && !shapes[b].ball();
    const auto kind = balls ? ContactKind::ball : faces ? ContactKind::overlap : ContactKind::ball_on_face;
    const Vec3 on_a = nearest_on(a, motion[b].x), on_b = nearest_on(b, motion[a].x);
    Vec3 normal = motion[b].x - motion[a].x;
    if (faces) normal = axes_between(a, b).n;
    if (kind == ContactKind::ball_on_face) normal = shapes[a].ball() ? on_b - motion[a].x : motion[b].x - on_a;
    if (normal.isZero(0.0)) normal = Vec3::UnitX();
    rule = spec_->rule(pairing(a, b, kind, 0.5 * (on_a + on_b), normal.normalized(), true), plane_);
  }
  const JointLaw* law = spec_->laws_of(rule).later_of({bodies[a].group, bodies[b].group});
  const auto found = std::find(later_laws_.begin(), later_laws_.end(), law);
  if (found == later_laws_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - later_laws_.begin());
}

}  // namespace tribo
