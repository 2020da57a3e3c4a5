// SPDX-License-Identifier: MIT
/// Principal values and axes of a symmetric tensor in closed form, accurate to round-off also for equal values.
#pragma once

#include "base/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tribo {

using Triple = std::array<double, 3>;

/// Ascending principal values and the corresponding unit axes.
struct Principal {
  Triple value;
  std::array<Triple, 3> axis;
};

/// The root of t^3 - 3 t = 2 r that lies in [sqrt 3, 2], for r in [0, 1]: 2 cos(acos(r)/3) without trigonometry.
/// The initial approximation has the right value and slope at both ends and an error below 4e-05; each Newton step
/// squares the error.
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
/// conditioned and are computed from the characteristic cubic and its cofactors. The other two are the principal values
/// of a 2x2 tensor in the plane normal to that axis, whose angle is well conditioned even if they are equal. Eberly, A
/// Robust Eigensolver for 3x3 Symmetric Matrices (2014).
///
/// Written without branches so that loops over points vectorise.
[[gnu::always_inline]] inline Principal principal(double xx, double yy, double zz, double xy, double yz, double xz) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const double mean = (xx + yy + zz) / 3;
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double J2 = 0.5 * (a * a + b * b + c * c) + xy * xy + yz * yz + xz * xz;
  const double idle = J2 < 1e-140 ? 1.0 : 0.0;  // isotropic: all axes are principal, the coordinate axes are taken

  const double J3 = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const double k = std::sqrt(J2 / 3), cosine3 = std::abs(J3) / (2 * k * k * k + tiny);
  const double apart = std::copysign(k * separate_root(cosine3 < 1 ? cosine3 : 1.0), J3);

  // the cofactors of (deviator - apart 1) are a multiple of v v^T; the largest column gives v
  const double A = a - apart, B = b - apart, C = c - apart;
  const double c00 = B * C - yz * yz, c11 = A * C - xz * xz, c22 = A * B - xy * xy;
  const double c01 = xz * yz - xy * C, c02 = xy * yz - xz * B, c12 = xy * xz - yz * A;
  const double d0 = std::abs(c00), d1 = std::abs(c11), d2 = std::abs(c22);
  const bool first = (d0 >= d1) & (d0 >= d2), second = d1 >= d2;
  const double n0 = second ? c01 : c02, n1 = second ? c11 : c12, n2 = second ? c12 : c22;
  const double w0 = (first ? c00 : n0) + idle, w1 = first ? c01 : n1, w2 = first ? c02 : n2;
  const double scale = 1 / std::sqrt(w0 * w0 + w1 * w1 + w2 * w2 + tiny);
  const double v0 = w0 * scale, v1 = w1 * scale, v2 = w2 * scale;

  // u is normal to v, w is normal to both
  const bool wide = std::abs(v0) > std::abs(v1);
  const double long_side = wide ? v0 : v1, shrink = 1 / std::sqrt(long_side * long_side + v2 * v2 + tiny);
  const double u0 = wide ? -v2 * shrink : 0.0, u1 = wide ? 0.0 : v2 * shrink, u2 = (wide ? v0 : -v1) * shrink;
  const double t0 = v1 * u2 - v2 * u1, t1 = v2 * u0 - v0 * u2, t2 = v0 * u1 - v1 * u0;

  const double p0 = a * u0 + xy * u1 + xz * u2, p1 = xy * u0 + b * u1 + yz * u2, p2 = xz * u0 + yz * u1 + c * u2;
  const double half = u0 * p0 + u1 * p1 + u2 * p2 + 0.5 * apart;  // the deviator has no trace
  const double off = t0 * p0 + t1 * p1 + t2 * p2;
  const double radius = std::sqrt(half * half + off * off);
  // cosine and sine of the angle theta with tan(2 theta) = off / half
  const double inverse = radius > 0 ? 1 / radius : 0.0, share = radius > 0 ? std::abs(half) * inverse : 1.0;
  const double big = std::sqrt(0.5 * (1 + share)), small = off * inverse / (2 * big);
  const double cosine = half >= 0 ? big : std::abs(small), sine = half >= 0 ? small : std::copysign(big, off);
  const double h0 = cosine * u0 + sine * t0, h1 = cosine * u1 + sine * t1, h2 = cosine * u2 + sine * t2;
  const double l0 = cosine * t0 - sine * u0, l1 = cosine * t1 - sine * u1, l2 = cosine * t2 - sine * u2;

  const double high = mean - 0.5 * apart + radius, low = mean - 0.5 * apart - radius, lone = mean + apart;
  const bool top = apart > 0;  // the separate value is the largest
  const double S1 = top ? low : lone, S2 = top ? high : low, S3 = top ? lone : high;
  const double x1 = top ? l0 : v0, y1 = top ? l1 : v1, z1 = top ? l2 : v2;
  const double x2 = top ? h0 : l0, y2 = top ? h1 : l1, z2 = top ? h2 : l2;
  const double x3 = top ? v0 : h0, y3 = top ? v1 : h1, z3 = top ? v2 : h2;
  return {{S1, S2, S3}, {{{x1, y1, z1}, {x2, y2, z2}, {x3, y3, z3}}}};
}

inline Principal principal(const Mat3& s) { return principal(s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)); }

}  // namespace tribo
