// SPDX-License-Identifier: MIT
/// Relative motion of two bodies at a contact during a step.
#pragma once

#include "blocks/assembly.hpp"

namespace tribo {

/// Position and axes of a contact; `couple` is BlockContact::couple.
struct ContactFrame {
  JointAxes axes;
  Vec3 at = Vec3::Zero();
  double couple = 0.0;
};

/// Axes in the plane of a normal there.
inline JointAxes plane_axes(const Vec3& n) { return {n, Vec3::UnitZ(), Vec3(n[1], -n[0], 0)}; }

/// Axes after the rotation to a new normal; the tangents follow the mean rotation of both bodies.
template <bool Plane>
[[gnu::always_inline]] inline JointAxes carried(JointAxes axes, const Vec3& n, const BlockMotion& a,
                                                const BlockMotion& b, double dt) {
  if constexpr (Plane) return plane_axes(n);
  if (n != axes.n || a.w != b.w || !a.w.isZero(0.0)) axes.follow(n, 0.25 * dt * (a.w + b.w).dot(axes.n + n));
  return axes;
}

/// Work on a joint in half a step of these increments, by the forces it has.
inline double half_work(const Joint& j, const JointIncrement& d) {
  return 0.5 * (j.Fn * d.normal - j.Fs.dot(d.shear) - j.Mt * d.twist - j.Mb.dot(d.bend));
}

/// Displacement and rotation of body b, after its shift, relative to body a: with the mean of the lever arms before and
/// after the step, along the mean of the axes. With rotations by dt w x (R_before + R_after)/2, as in the
/// update of the bodies, a pair in rigid motion has exactly no increment, and the work of a contact equals the work of
/// its forces in leapfrog to third order of the step.
template <bool Plane>
[[gnu::always_inline]] inline void count_increment(const BlockMotion& a, const BlockMotion& b, const Vec3& shift,
                                                   const Vec3& shift_velocity, const ContactFrame& before,
                                                   const ContactFrame& after, double dt, JointIncrement& d) {
  const Vec3 middle = 0.5 * (before.at + after.at), vb = b.v + shift_velocity;
  const Vec3 arm_a = middle - a.x + 0.5 * dt * a.v, arm_b = middle - b.x - shift + 0.5 * dt * vb;
  const Vec3 n = 0.5 * (before.axes.n + after.axes.n);
  d.dt = dt;
  if constexpr (Plane) {
    const double wa = a.w[2], wb = b.w[2];
    const double x = dt * (vb[0] - a.v[0] - wb * arm_b[1] + wa * arm_a[1]),
                 y = dt * (vb[1] - a.v[1] + wb * arm_b[0] - wa * arm_a[0]);
    d.normal = n[0] * x + n[1] * y, d.shear = {0.0, n[1] * x - n[0] * y};
    d.twist = 0.0, d.bend = {dt * (wb - wa), 0.0};
  } else {
    const Vec3 s = 0.5 * (before.axes.s + after.axes.s), t = 0.5 * (before.axes.t + after.axes.t);
    const Vec3 apart = dt * (vb + b.w.cross(arm_b) - a.v - a.w.cross(arm_a)), turned = dt * (b.w - a.w);
    d.normal = n.dot(apart) + 0.5 * (before.couple + after.couple) * n.dot(turned);
    d.shear = {s.dot(apart), t.dot(apart)};
    d.twist = n.dot(turned), d.bend = {s.dot(turned), t.dot(turned)};
  }
}

}  // namespace tribo
