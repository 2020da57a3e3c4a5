// SPDX-License-Identifier: MIT
/// Geometry for the hosts of joints: contact axes that follow the faces, moments of polygons, and the force of the
/// fictitious stress.
#pragma once

#include "base/types.hpp"
#include "contact/tangent.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace tribo {

/// Unit axes of a contact, right-handed: n x s = t.
struct JointAxes {
  Vec3 n = Vec3::UnitX(), s = Vec3::UnitY(), t = Vec3::UnitZ();

  /// Axes with the given normal. If n_z = 0, as in two dimensions, s is the z axis, so that t = (n_y, -n_x, 0).
  static JointAxes of_normal(const Vec3& n);
  /// Rotates the axes to a new unit `normal` by the smallest rotation, then about it by the angle 2 atan(spin/2), where
  /// `spin` is the mean rotation of both bodies about the normal in the step [rad]. This is the angle by which the
  /// midpoint rule turns a body, and equals `spin` to third order.
  void follow(const Vec3& normal, double spin);

  Tangent tangent(const Vec3& v) const { return {v.dot(s), v.dot(t)}; }
  Vec3 vector(const Tangent& v) const { return v.s * s + v.t * t; }
};

inline void JointAxes::follow(const Vec3& normal, double spin) {
  const double c = n.dot(normal);
  if (c < -0.999999) {  // reversed in one step: the smallest rotation is undefined
    *this = of_normal(normal);
    return;
  }
  Vec3 along = s - s.dot(normal) / (1 + c) * (n + normal);
  along -= along.dot(normal) * normal;       // round-off, which would add up,
  along *= 1.5 - 0.5 * along.squaredNorm();  // as would that of the length
  const Vec3 across = normal.cross(along);
  const double half = 0.5 * spin, part = 1 / (1 + half * half);
  const double cosine = (1 - half * half) * part, sine = 2 * half * part;
  n = normal, s = cosine * along + sine * across, t = cosine * across - sine * along;
}

inline void archive(Archive& a, JointAxes& axes) {
  auto& [n, s, t] = axes;
  a("n", n), a("s", s), a("t", t);
  static constexpr double tolerance = 1e-3;
  const double skew = std::max({std::abs(n.norm() - 1), std::abs(s.norm() - 1), std::abs(t.norm() - 1),
                                std::abs(n.dot(s)), std::abs(n.dot(t)), std::abs(s.dot(t))});
  if (a.reading() && !(skew < tolerance)) refuse_checkpoint("the axes of a joint are not at right angles");
}

/// Area, centroid and second moments of a plane polygon about its centroid. The corners may run either way.
/// I_s = int t^2, I_t = int s^2, I_st = int s t.
struct PolygonMoments {
  double area = 0.0, I_s = 0.0, I_t = 0.0, I_st = 0.0;
  Tangent centroid;
};
PolygonMoments polygon_moments(std::span<const Tangent> corners);

/// Force on body 2 caused by the fictitious stress that gives a spring network the Poisson's ratio nu: A sigma^f n with
/// sigma^f_ii = -nu (tr sigma - sigma_ii) and sigma^f_ij = off_diagonal nu sigma_ij in global axes.
/// `stress`: mean stress of the two bodies, tension positive; `area`: contact area.
/// Asahina et al., Int. J. Rock Mech. Min. Sci. 75 (2015) 189-201.
struct PoissonForce {
  double normal = 0.0;  ///< positive in tension
  Tangent shear;
};
PoissonForce poisson_force(const Mat3& stress, double nu, double off_diagonal, double area, const JointAxes& axes);

}  // namespace tribo
