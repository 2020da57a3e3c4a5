// SPDX-License-Identifier: MIT
/// Increments of contacts whose position is computed in every step: overlapping polygons and polyhedra, balls on faces.

#include "blocks/kinematics.hpp"

#include <cmath>
#include <numbers>

namespace tribo {

void Assembly::place(std::size_t k, PlacedBlock& to) const {
  to.place(shapes[k], edges_.empty() ? std::span<const BlockEdge>{} : edges_[k], motion[k].x, motion[k].R, plane_);
}

Vec3 Assembly::nearest_on(std::size_t k, const Vec3& x) const {
  const BlockMotion& m = motion[k];
  if (shapes[k].ball()) return m.x + shapes[k].radius * (x - m.x).normalized();
  return m.x + m.R * nearest_point(shapes[k], m.R.transpose() * (x - m.x), plane_).at;
}

// Moves a contact to a position and normal, and computes the increments of its bodies there. An overlap may jump to
// another face: then the old forces act in the first half of the step at the old position, the new ones in the second.
template <bool Plane>
void Assembly::move_contact(std::size_t k, const Vec3& n, const Vec3& at, double dt, JointIncrement& d) {
  BlockContact& c = contacts[k];
  const BlockMotion &a = motion[c.a], &b = motion[c.b];
  const ContactFrame before{c.axes, contact_forces[k].at};
  c.axes = carried<Plane>(c.axes, n, a, b, dt);
  const ContactFrame now{c.axes, at};
  Joint& j = joints[k];
  const double reach = plane_ ? j.area / thickness_ : std::sqrt(j.area);
  const bool jumps = before.axes.n.dot(n) < 1 - 1e-5 || (at - before.at).norm() > 0.02 * reach;
  count_increment<Plane>(a, b, Vec3::Zero(), Vec3::Zero(), jumps ? now : before, now, dt, d);
  if (jumps && !contact_forces[k].all.isZero(0.0)) {
    JointIncrement old;
    count_increment<Plane>(a, b, Vec3::Zero(), Vec3::Zero(), before, before, dt, old);
    j.work += half_work(j, old) - half_work(j, d);
    dashpot_work[k] += 0.5 * (j.dashpot_normal * (old.normal - d.normal) - j.dashpot_shear.dot(old.shear - d.shear));
  }
  contact_forces[k].at = at, d.mass = c.mass;
}

// Area that leaves a contact takes its fraction of the shear force along. In this step the whole force still acts.
void Assembly::resize(Joint& j, double area, const JointIncrement& d) const {
  if (const double kept = area / j.area; kept < 1) {
    j.work -= 0.5 * (1 - kept) * (j.Fs.dot(d.shear) + j.Mt * d.twist + j.Mb.dot(d.bend));
    j.Fs *= kept, j.Mt *= kept, j.Mb *= kept;
  }
  j.area = area, j.radius = plane_ ? 0.5 * area / thickness_ : std::sqrt(area / std::numbers::pi);
}

// Faces that were in contact at their middle only may overlap elsewhere when an overlap replaces them. If its springs
// were to press more than the faces did, they begin with the force of the faces, distributed as the overlap is. Where
// the blocks part, the gap without force follows them until they no longer overlap.
void Assembly::begin_without_jump(BlockContact& c, Joint& j, double gap, double mean_gap, double area) {
  if (c.replaced) {
    const double whole = j.kn * area * mean_gap;
    if (whole < *c.replaced) j.rest_gap = (gap < 0 ? gap : mean_gap) * (1 - *c.replaced / whole);
    c.replaced.reset();
  } else if (j.away && j.rest_gap < 0) {
    j.rest_gap = std::min(0.0, std::max(j.rest_gap, gap));
  }
}

void Assembly::overlap_increments(const Batch& batch, double dt, JointIncrement* d) {
  thread_local PlacedBlock a, b;
  std::array<SharedPart, 4> of_pair;
  const std::span<SharedPart> parts(of_pair.data(), shared_parts(plane_));
  BlockGap apart;
  bool shared = false;
  const double closed = groups[batch.group].law->proximity();
  for (std::size_t k = batch.begin; k < batch.end; ++k, ++d) {
    BlockContact& c = contacts[k];
    if (k == batch.begin || c.part == 0) {
      place(c.a, a), place(c.b, b);
      apart = separation(a, b, plane_, plane_ ? 1e300 : 0.0);
      shared = false;
    }
    const Vec3 middle = 0.5 * (a.centre + b.centre);
    if (apart.gap >= 0) {
      plane_ ? move_contact<true>(k, apart.n, middle, dt, *d) : move_contact<false>(k, apart.n, middle, dt, *d);
      d->gap = apart.gap;
      begin_without_jump(c, joints[k], d->gap - closed, 0.0, 0.0);
      continue;
    }
    if (!shared) {  // cut along the axes of this step, which all parts of a pair use
      const auto& carry = plane_ ? carried<true> : carried<false>;
      share(a, b, carry(c.axes, apart.n, motion[c.a], motion[c.b], dt), plane_, parts);
      shared = true;
    }
    const SharedPart& part = parts[c.part];
    plane_ ? move_contact<true>(k, apart.n, part.at, dt, *d) : move_contact<false>(k, apart.n, part.at, dt, *d);
    d->gap = part.area > 0 ? -part.volume / part.area : 0.0;
    double area = 0, volume = 0;
    for (const SharedPart& p : parts) area += p.area, volume += p.volume;
    begin_without_jump(c, joints[k], d->gap - closed, (area > 0 ? -volume / area : 0.0) - closed,
                       plane_ ? area * thickness_ : area);
    if (part.area > 0) resize(joints[k], plane_ ? part.area * thickness_ : part.area, *d);
  }
}

void Assembly::ball_on_face_increments(const Batch& batch, double dt, JointIncrement* d) {
  for (std::size_t k = batch.begin; k < batch.end; ++k, ++d) {
    const BlockContact& c = contacts[k];
    const bool first = shapes[c.a].ball();
    const std::uint32_t ball = first ? c.a : c.b, body = first ? c.b : c.a;
    const BlockMotion& m = motion[body];
    const NearestPoint near = nearest_point(shapes[body], m.R.transpose() * (motion[ball].x - m.x), plane_);
    const Vec3 out = m.R * near.out, n = first ? Vec3(-out) : out;
    const double gap = near.distance - shapes[ball].radius;
    const Vec3 at = m.x + m.R * near.at + 0.5 * gap * out;
    plane_ ? move_contact<true>(k, n, at, dt, *d) : move_contact<false>(k, n, at, dt, *d);
    d->gap = gap;
  }
}

}  // namespace tribo
