// SPDX-License-Identifier: MIT
/// Geometry that hosts of joints share: axes that move along, moments of faces, forces of the fictitious stress.
#pragma once

#include "base/types.hpp"
#include "contact/tangent.hpp"

#include <span>

namespace tribo {

/// Axes of a contact, right-handed: n x s = t.
struct JointAxes {
  Vec3 n = Vec3::UnitX(), s = Vec3::UnitY(), t = Vec3::UnitZ();

  /// Any tangents; in the plane z = 0, s is the z axis, so that t = (n_y, -n_x, 0).
  static JointAxes of_normal(const Vec3& n);
  /// Carries the tangents along with the normal: by the smallest rotation from the old normal to `normal`, then by
  /// `spin`, the angle [rad] by which both bodies turned about it on average.
  void follow(const Vec3& normal, double spin);

  Tangent tangent(const Vec3& v) const { return {v.dot(s), v.dot(t)}; }
  Vec3 vector(const Tangent& v) const { return v.s * s + v.t * t; }
};

inline void archive(Archive& a, JointAxes& axes) {
  auto& [n, s, t] = axes;
  a("n", n), a("s", s), a("t", t);
}

/// Area, centroid and second moments of a polygon about its centroid, whatever its orientation.
/// I_s = int t^2, I_t = int s^2, I_st = int s t.
struct PolygonMoments {
  double area = 0.0, I_s = 0.0, I_t = 0.0, I_st = 0.0;
  Tangent centroid;
};
PolygonMoments polygon_moments(std::span<const Tangent> corners);

/// Force on body 2 of the fictitious stress that gives a network of springs Poisson's ratio nu: A sigma^f n with
/// sigma^f_ii = -nu (tr sigma - sigma_ii), sigma^f_ij = off_diagonal nu sigma_ij, in the global axes.
/// Asahina et al., Int. J. Rock Mech. Min. Sci. 75 (2015) 189-201.
struct PoissonForce {
  double normal = 0.0;  ///< positive in tension
  Tangent shear;
};
PoissonForce poisson_force(const Mat3& stress, double nu, double off_diagonal, double area, const JointAxes& axes);

}  // namespace tribo
