/// Principal values and axes of a symmetric tensor in closed form, exact to round-off also for equal values.
#pragma once

#include "base/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tribo {

using Triple = std::array<double, 3>;

/// Ascending principal values and the unit axes that belong to them.
struct Principal {
  Triple value;
  std::array<Triple, 3> axis;
};

/// The root of t^3 - 3 t = 2 r that lies in [sqrt 3, 2], for r in [0, 1]: 2 cos(acos(r)/3) without trigonometry.
/// The start matches value and slope at both ends and is within 4e-05; each Newton step squares that.
inline double separate_root(double r) {
  constexpr double root3 = 1.7320508075688772, bend = root3 + 1.0 / 3.0 - 2.0, skew = 1.0 / 9.0 - 2.0 * bend,
                   bulge = -0.00857;
  const double q = r * (1 - r);
  double t = root3 + r * (1.0 / 3.0 + r * (-bend + skew * (1 - r))) + bulge * q * q;
  t -= (t * (t * t - 3) - 2 * r) / (3 * (t * t - 1));
  t -= (t * (t * t - 3) - 2 * r) / (3 * (t * t - 1));
  return t;
}

/// Principal values and axes of the tensor (xx yy zz xy yz xz).
///
/// Of three values that sum to zero, one is at least sqrt(J2) away from the other two. It and its axis are well
/// conditioned and come from the characteristic cubic and its cofactors; the two others are those of a 2x2 tensor in
/// the plane across that axis, whose angle is well conditioned even when they are equal. Eberly, A Robust Eigensolver
/// for 3x3 Symmetric Matrices (2014).
inline Principal principal(double xx, double yy, double zz, double xy, double yz, double xz) {
  const double mean = (xx + yy + zz) / 3;
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double J2 = 0.5 * (a * a + b * b + c * c) + xy * xy + yz * yz + xz * xz;
  if (!(J2 > 1e-32 * mean * mean + std::numeric_limits<double>::min() * 1e20))
    return {{mean, mean, mean}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

  const double J3 = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const double k = std::sqrt(J2 / 3);
  const double t = separate_root(std::min(1.0, std::abs(J3) / (2 * k * k * k)));
  const double apart = std::copysign(k * t, J3);

  // cofactors of (deviator - apart) are a multiple of v v^T
  const double A = a - apart, B = b - apart, C = c - apart;
  const double c00 = B * C - yz * yz, c11 = A * C - xz * xz, c22 = A * B - xy * xy;
  const double c01 = xz * yz - xy * C, c02 = xy * yz - xz * B, c12 = xy * xz - yz * A;
  Triple v;
  const double d0 = std::abs(c00), d1 = std::abs(c11), d2 = std::abs(c22);
  if (d0 >= d1 && d0 >= d2)
    v = {c00, c01, c02};
  else if (d1 >= d2)
    v = {c01, c11, c12};
  else
    v = {c02, c12, c22};
  const double scale = 1 / std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double& x : v) x *= scale;

  Triple u;
  if (std::abs(v[0]) > std::abs(v[1])) {
    const double s = 1 / std::sqrt(v[0] * v[0] + v[2] * v[2]);
    u = {-v[2] * s, 0, v[0] * s};
  } else {
    const double s = 1 / std::sqrt(v[1] * v[1] + v[2] * v[2]);
    u = {0, v[2] * s, -v[1] * s};
  }
  const Triple w{v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]};

  const double p0 = a * u[0] + xy * u[1] + xz * u[2], p1 = xy * u[0] + b * u[1] + yz * u[2],
               p2 = xz * u[0] + yz * u[1] + c * u[2];
  const double half = u[0] * p0 + u[1] * p1 + u[2] * p2 + 0.5 * apart;  // the deviator has no trace
  const double off = w[0] * p0 + w[1] * p1 + w[2] * p2;
  const double radius = std::sqrt(half * half + off * off);
  double cosine = 1, sine = 0;  // of half the angle 2 theta, tan(2 theta) = off / half
  if (radius > 0) {
    const double big = std::sqrt(0.5 * (1 + std::abs(half) / radius)), small = off / (2 * radius * big);
    cosine = half >= 0 ? big : std::abs(small);
    sine = half >= 0 ? small : std::copysign(big, off);
  }
  Triple high, low;
  for (std::size_t i = 0; i < 3; ++i) {
    high[i] = cosine * u[i] + sine * w[i];
    low[i] = cosine * w[i] - sine * u[i];
  }
  const double centre = mean - 0.5 * apart;
  if (apart > 0) return {{centre - radius, centre + radius, mean + apart}, {low, high, v}};
  return {{mean + apart, centre - radius, centre + radius}, {v, low, high}};
}

inline Principal principal(const Mat3& s) { return principal(s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)); }

}  // namespace tribo
