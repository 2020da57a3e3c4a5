// SPDX-License-Identifier: MIT
#include "contact/joint_geometry.hpp"

#include <cmath>
#include <vector>

namespace tribo {

JointAxes JointAxes::of_normal(const Vec3& n) {
  JointAxes out;
  out.n = n.normalized();
  if (out.n[2] == 0)
    out.s = Vec3::UnitZ();
  else
    out.s = out.n.cross(std::abs(out.n[0]) < 0.9 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  out.t = out.n.cross(out.s);
  return out;
}

PolygonMoments polygon_moments(std::span<const Tangent> corners) {
  PolygonMoments out;
  const std::size_t count = corners.size();
  const auto next = [&](std::size_t k) { return k + 1 == count ? 0 : k + 1; };
  double area = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Tangent &a = corners[k], &b = corners[next(k)];
    const double cross = a.s * b.t - b.s * a.t;
    area += 0.5 * cross;
    out.centroid += cross * (a + b);
  }
  if (area == 0) return out;
  out.centroid *= 1 / (6 * area);
  const double sign = area < 0 ? -1 : 1;
  out.area = std::abs(area);
  for (std::size_t k = 0; k < count; ++k) {
    const Tangent a = corners[k] - out.centroid, b = corners[next(k)] - out.centroid;
    const double cross = sign * (a.s * b.t - b.s * a.t);
    out.I_s += cross / 12 * (a.t * a.t + a.t * b.t + b.t * b.t);
    out.I_t += cross / 12 * (a.s * a.s + a.s * b.s + b.s * b.s);
    out.I_st += cross / 24 * (a.s * b.t + 2 * a.s * a.t + 2 * b.s * b.t + b.s * a.t);
  }
  return out;
}

PoissonForce poisson_force(const Mat3& stress, double nu, double off_diagonal, double area, const JointAxes& axes) {
  Mat3 fictitious = off_diagonal * nu * stress;
  for (int i = 0; i < 3; ++i) fictitious(i, i) = -nu * (stress.trace() - stress(i, i));
  const Vec3 force = area * fictitious * axes.n;
  return {-force.dot(axes.n), axes.tangent(force)};
}

}  // namespace tribo
