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
void Assembly::move_contact(std::size_t k, const ContactFrame& to, double dt, JointIncrement& d) {
  BlockContact& c = contacts[k];
  const BlockMotion &a = motion[c.a], &b = motion[c.b];
  const ContactFrame before{c.axes, contact_forces[k].at, c.couple};
  const Vec3& n = to.axes.n;
  c.axes = carried<Plane>(c.axes, n, a, b, dt), c.couple = to.couple;
  const ContactFrame now{c.axes, to.at, c.couple};
  Joint& j = joints[k];
  const double reach = plane_ ? j.area / thickness_ : std::sqrt(j.area);
  const bool jumps = before.axes.n.dot(n) < 1 - 1e-5 || (to.at - before.at).norm() > 0.02 * reach ||
                     std::abs(now.couple - before.couple) > 0.02 * reach;
  count_increment<Plane>(a, b, Vec3::Zero(), Vec3::Zero(), jumps ? now : before, now, dt, d);
  if (jumps && !contact_forces[k].all.isZero(0.0)) {
    JointIncrement old;
    count_increment<Plane>(a, b, Vec3::Zero(), Vec3::Zero(), before, before, dt, old);
    j.work += half_work(j, old) - half_work(j, d);
    dashpot_work[k] += 0.5 * (j.dashpot_normal * (old.normal - d.normal) - j.dashpot_shear.dot(old.shear - d.shear));
  }
  contact_forces[k].at = to.at, d.mass = c.mass;
}

// Area that leaves a contact takes its fraction of the shear force along. In this step the whole force still acts.
void Assembly::resize(Joint& j, double area, const JointIncrement& d) const {
  if (const double kept = area / j.area; kept < 1) {
    j.work -= 0.5 * (1 - kept) * (j.Fs.dot(d.shear) + j.Mt * d.twist + j.Mb.dot(d.bend));
    j.Fs *= kept, j.Mt *= kept, j.Mb *= kept;
  }
  j.area = area, j.radius = plane_ ? 0.5 * area / thickness_ : std::sqrt(area / std::numbers::pi);
}

// Blocks that press from a gap on overlap as if the first one were larger by that; at its corners by somewhat more.
void Assembly::find_overlap(OverlapNow& now) const {
  const double reach = 3 * now.closed;
  now.apart = separation(now.a, now.b, plane_, plane_ ? 1e300 : reach);
  now.a.grown = now.closed;
  now.found = now.apart.gap < reach && now.region.find(now.a, now.b, now.apart.n, plane_);
}

void Assembly::set_back(OverlapNow& now, std::size_t face, double by) const {
  const std::size_t of_a = now.a.normals.size();
  face < of_a ? now.a.set_back(face, by) : now.b.set_back(face - of_a, by);
}

// Where the blocks part, a face that was set back follows the other block until it is where it should be.
void Assembly::follow_set_back(OverlapNow& now) const {
  set_back(now, now.face, now.set_back);
  find_overlap(now);
  if (now.found) return;
  const BlockGap apart = now.apart;
  set_back(now, now.face, -now.set_back);
  find_overlap(now);
  const std::size_t of_a = now.a.normals.size();
  const double deepest = !now.found        ? 0.0
                         : now.face < of_a ? now.region.deepest(now.a, now.face)
                                           : now.region.deepest(now.b, now.face - of_a);
  now.set_back = std::min(now.set_back, deepest);
  if (now.found) now.apart = apart, now.found = false;
}

// Faces that were in contact at their middle only may overlap elsewhere when an overlap replaces them. If its springs
// were to press more or to store more than those of the faces did, one of its faces is set back as far as needed.
void Assembly::begin_as_faces(OverlapNow& now, const JointAxes& axes, const FormerFaces& faces,
                              double stiffness) const {
  const std::span<SharedPart> parts(now.parts.data(), shared_parts(plane_));
  const auto too_much = [&] {
    if (!now.found) return false;
    now.region.share(axes, parts);
    FormerFaces sum;
    for (const SharedPart& p : parts) {
      const double force = stiffness * p.area * p.depth;
      sum.force += force, sum.energy += 0.5 * force * p.depth;
    }
    return sum.force > faces.force || sum.energy > faces.energy;
  };
  if (!now.found || !too_much()) return;
  const std::size_t face = now.region.face(), of_a = now.a.normals.size();
  double low = 0.0, high = face < of_a ? now.region.deepest(now.a, face) : now.region.deepest(now.b, face - of_a);
  const PlacedBlock a = now.a, b = now.b;
  const auto try_out = [&](double by) {
    now.a = a, now.b = b;
    set_back(now, face, by), find_overlap(now);
    return too_much();
  };
  for (int pass = 0; pass < 60 && high - low > 1e-12 * high; ++pass) {
    const double middle = 0.5 * (low + high);
    (try_out(middle) ? low : high) = middle;
  }
  try_out(high);
  now.face = static_cast<std::uint32_t>(face), now.set_back = high;
}

void Assembly::place_overlap(std::size_t k, double dt, OverlapNow& now) const {
  const BlockContact& c = contacts[k];
  place(c.a, now.a), place(c.b, now.b);
  now.face = c.face, now.set_back = c.set_back;
  now.set_back > 0 ? follow_set_back(now) : find_overlap(now);
  if (!now.found) return;
  // cut along the axes of this step, which all parts of a pair use
  const auto axes = [&] {
    return (plane_ ? carried<true> : carried<false>)(c.axes, now.region.normal(), motion[c.a], motion[c.b], dt);
  };
  if (c.replaced && now.set_back == 0)
    begin_as_faces(now, axes(), *c.replaced, joints[k].kn * (plane_ ? thickness_ : 1.0));
  now.region.share(axes(), {now.parts.data(), shared_parts(plane_)});
}

void Assembly::overlap_increments(const Batch& batch, double dt, JointIncrement* d) {
  thread_local OverlapNow now;
  now.closed = groups[batch.group].law->proximity();
  const auto move = [&](std::size_t k, const Vec3& n, const Vec3& at, double couple) {
    const ContactFrame to{{n, Vec3::Zero(), Vec3::Zero()}, at, couple};
    plane_ ? move_contact<true>(k, to, dt, *d) : move_contact<false>(k, to, dt, *d);
  };
  for (std::size_t k = batch.begin; k < batch.end; ++k, ++d) {
    BlockContact& c = contacts[k];
    if (k == batch.begin || c.part == 0) place_overlap(k, dt, now);
    c.face = now.face, c.set_back = now.set_back, c.replaced.reset();
    Joint& j = joints[k];
    if (now.found) {
      const SharedPart& part = now.parts[c.part];
      move(k, part.n, part.at, part.couple);
      d->gap = now.closed - part.depth;
      if (part.area > 0) resize(j, plane_ ? part.area * thickness_ : part.area, *d);
    } else {
      move(k, now.apart.n, 0.5 * (now.a.centre + now.b.centre), 0.0);
      d->gap = std::max(now.closed, now.apart.gap);
    }
    // a gap without force follows blocks that part until they no longer overlap
    if (j.away && j.rest_gap < 0) j.rest_gap = std::min(0.0, std::max(j.rest_gap, d->gap - now.closed));
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
    const ContactFrame to{{n, Vec3::Zero(), Vec3::Zero()}, at, 0.0};
    plane_ ? move_contact<true>(k, to, dt, *d) : move_contact<false>(k, to, dt, *d);
    d->gap = gap;
  }
}

}  // namespace tribo
