// SPDX-License-Identifier: MIT
/// Loops of the Mohr-Coulomb law over a run of points: the check for yield, and the returns of mohr_coulomb_planes.hpp
/// applied to stresses and history.
#pragma once

#include "materials/mohr_coulomb_planes.hpp"
#include "materials/principal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tribo {

inline constexpr int chunk = 128;  ///< points per run; their trial stresses fit into the first-level cache

/// A run of points of a batch, with pointers to its history columns.
template <int Dim>
struct Slice {
  MaterialPoints<Dim> points;
  std::array<double*, 5> columns;

  Slice(const MaterialPoints<Dim>& all, int begin) : points(all) {
    points.count = std::min(chunk, all.count - begin);
    for (auto& c : points.L) c += begin;
    for (auto& c : points.F) c += begin;
    for (auto& c : points.stress) c += begin;
    points.volume += begin;
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = all.history[k] + begin;
  }
  MohrCoulombState load(int i) const {
    return {columns[0][i], columns[1][i], columns[2][i], columns[3][i], columns[4][i]};
  }
  void store(const MohrCoulombState& s, int i) const {
    columns[0][i] = s.plastic_shear, columns[1][i] = s.plastic_volume;
    columns[2][i] = s.tension_strain, columns[3][i] = s.dissipation, columns[4][i] = s.opening;
  }
};

template <int Dim>
[[gnu::always_inline]] inline double volume_ratio(const MaterialPoints<Dim>& points, int i) {
  const auto& F = points.F;
  if constexpr (Dim == 2)
    return (F[0][i] * F[3][i] - F[1][i] * F[2][i]) * F[4][i];
  else
    return F[0][i] * (F[4][i] * F[8][i] - F[5][i] * F[7][i]) - F[1][i] * (F[3][i] * F[8][i] - F[5][i] * F[6][i]) +
           F[2][i] * (F[3][i] * F[7][i] - F[4][i] * F[6][i]);
}

// Largest violation of the yield conditions at each point [stress]; exact in two dimensions.
inline void yield_bound(const MaterialPoints<2>& points, const Strength& s, double* bound) {
  const double high = 0.5 * (1 + s.sin_friction), low = 0.5 * (1 - s.sin_friction);
  const double resistance = s.cohesion * s.cos_friction, tension = s.tension;
  const double* __restrict xx = points.stress[0];
  const double* __restrict yy = points.stress[1];
  const double* __restrict zz = points.stress[2];
  const double* __restrict xy = points.stress[3];
#pragma omp simd
  for (int i = 0; i < points.count; ++i) {
    const double mean = 0.5 * (xx[i] + yy[i]), half = 0.5 * (xx[i] - yy[i]);
    const double radius = std::sqrt(half * half + xy[i] * xy[i]);
    const double S1 = std::min(mean - radius, zz[i]), S3 = std::max(mean + radius, zz[i]);
    bound[i] = std::max(high * S3 - low * S1 - resistance, S3 - tension);
  }
}

// In three dimensions: an upper bound without principal values. F = p sin phi + sqrt(J2) (cos theta - sin theta
// sin phi/sqrt 3) - c cos phi and S3 = p + 2 sqrt(J2/3) sin(theta + 120 deg), each at its least favourable Lode angle.
inline void yield_bound(const MaterialPoints<3>& points, const Strength& s, double* bound) {
  const double steep = std::sqrt(1 + s.sin_friction * s.sin_friction / 3), root = std::sqrt(4.0 / 3.0);
  const double resistance = s.cohesion * s.cos_friction, tension = s.tension, sine = s.sin_friction;
  const double* __restrict xx = points.stress[0];
  const double* __restrict yy = points.stress[1];
  const double* __restrict zz = points.stress[2];
  const double* __restrict xy = points.stress[3];
  const double* __restrict yz = points.stress[4];
  const double* __restrict xz = points.stress[5];
#pragma omp simd
  for (int i = 0; i < points.count; ++i) {
    const double p = (xx[i] + yy[i] + zz[i]) / 3;
    const double a = xx[i] - p, b = yy[i] - p, c = zz[i] - p;
    const double q = std::sqrt(0.5 * (a * a + b * b + c * c) + xy[i] * xy[i] + yz[i] * yz[i] + xz[i] * xz[i]);
    bound[i] = std::max(p * sine + q * steep - resistance, p + root * q - tension);
  }
}

// Updates the history columns for plastic flow, from the changes c of the principal stresses S.
struct PlasticHistory {
  double* __restrict shear;
  double* __restrict volume;
  double* __restrict tension;
  double* __restrict dissipation;
  double* __restrict opening;
  double half_compliance, third_compliance;  // 1/(2 mu), 1/(3 K)

  template <int Dim>
  PlasticHistory(const Slice<Dim>& slice, const Elasticity& e)
      : shear(slice.columns[0]),
        volume(slice.columns[1]),
        tension(slice.columns[2]),
        dissipation(slice.columns[3]),
        opening(slice.columns[4]),
        half_compliance(0.5 / e.mu),
        third_compliance(1 / (3 * e.bulk())) {}

  [[gnu::always_inline]] void add(int i, double S1, double S2, double S3, const Change& c, double J) const {
    const double mean = (c.c1 + c.c2 + c.c3) / 3, d1 = c.c1 - mean, d2 = c.c2 - mean, d3 = c.c3 - mean;
    const double share = mean * third_compliance;
    shear[i] += half_compliance * std::sqrt(0.5 * (d1 * d1 + d2 * d2 + d3 * d3));
    volume[i] += 3 * share;
    tension[i] += c.opening;
    opening[i] += c.opening;
    dissipation[i] += J * ((S1 - c.c1) * (half_compliance * d1 + share) + (S2 - c.c2) * (half_compliance * d2 + share) +
                           (S3 - c.c3) * (half_compliance * d3 + share));
  }
};

// Returns the points beyond yield for which `change` is valid, and sets their `bound` to 0.
template <class Return>
void flow(const Slice<2>& slice, const Return change, const PlasticHistory plastic_history, double* __restrict bound) {
  double* __restrict xx = slice.points.stress[0];
  double* __restrict yy = slice.points.stress[1];
  double* __restrict zz = slice.points.stress[2];
  double* __restrict xy = slice.points.stress[3];
#pragma omp simd
  for (int i = 0; i < slice.points.count; ++i) {
    const double mean = 0.5 * (xx[i] + yy[i]), half = 0.5 * (xx[i] - yy[i]), t = xy[i], z = zz[i];
    const double radius = std::sqrt(half * half + t * t), low = mean - radius, high = mean + radius;
    const bool first = z <= low, last = !first & (z > high);  // position of zz among the principal values
    const double S1 = first ? z : low, S3 = last ? z : high, S2 = first ? low : last ? high : z;
    Change c = change(S1, S2, S3);
    const bool here = (bound[i] > 0) & ((c.c1 != 0) | (c.c2 != 0) | (c.c3 != 0));
    c.c1 = here ? c.c1 : 0.0, c.c2 = here ? c.c2 : 0.0, c.c3 = here ? c.c3 : 0.0, c.opening = here ? c.opening : 0.0;
    const double c_low = first ? c.c2 : c.c1, c_high = last ? c.c2 : c.c3;
    const double turn = radius > 0 ? 0.5 * (c_high - c_low) / radius : 0.0, centre = 0.5 * (c_high + c_low);
    xx[i] -= centre + turn * half;
    yy[i] -= centre - turn * half;
    xy[i] -= turn * t;
    zz[i] -= first ? c.c1 : last ? c.c3 : c.c2;
    plastic_history.add(i, S1, S2, S3, c, volume_ratio<2>(slice.points, i));
    bound[i] = here ? 0.0 : bound[i];
  }
}

// Principal values and axes of a slice: S1 S2 S3 and the axes of S1, S2, S3.
using Spectrum = std::array<std::array<double, chunk>, 12>;

inline void decompose(const Slice<3>& slice, Spectrum& spectrum) {
  const auto& s = slice.points.stress;
  const double* __restrict xx = s[0];
  const double* __restrict yy = s[1];
  const double* __restrict zz = s[2];
  const double* __restrict xy = s[3];
  const double* __restrict yz = s[4];
  const double* __restrict xz = s[5];
// not `omp simd`: it keeps the local Principal in memory, and the loop is then not vectorised
#pragma GCC ivdep
  for (int i = 0; i < slice.points.count; ++i) {
    const Principal p = principal(xx[i], yy[i], zz[i], xy[i], yz[i], xz[i]);
    const auto n = static_cast<std::size_t>(i);
    spectrum[0][n] = p.value[0], spectrum[1][n] = p.value[1], spectrum[2][n] = p.value[2];
    spectrum[3][n] = p.axis[0][0], spectrum[4][n] = p.axis[0][1], spectrum[5][n] = p.axis[0][2];
    spectrum[6][n] = p.axis[1][0], spectrum[7][n] = p.axis[1][1], spectrum[8][n] = p.axis[1][2];
    spectrum[9][n] = p.axis[2][0], spectrum[10][n] = p.axis[2][1], spectrum[11][n] = p.axis[2][2];
  }
}

template <class Return>
void flow(const Slice<3>& slice, const Spectrum& spectrum, const Return change, const PlasticHistory plastic_history,
          double* __restrict bound) {
  double* __restrict xx = slice.points.stress[0];
  double* __restrict yy = slice.points.stress[1];
  double* __restrict zz = slice.points.stress[2];
  double* __restrict xy = slice.points.stress[3];
  double* __restrict yz = slice.points.stress[4];
  double* __restrict xz = slice.points.stress[5];
  const double* first = spectrum[0].data();
  const auto part = [first](int k, int i) { return first[k * chunk + i]; };
#pragma omp simd
  for (int i = 0; i < slice.points.count; ++i) {
    const double S1 = part(0, i), S2 = part(1, i), S3 = part(2, i);
    Change x = change(S1, S2, S3);
    const bool here = (bound[i] > 0) & ((x.c1 != 0) | (x.c2 != 0) | (x.c3 != 0));
    x.c1 = here ? x.c1 : 0.0, x.c2 = here ? x.c2 : 0.0, x.c3 = here ? x.c3 : 0.0, x.opening = here ? x.opening : 0.0;
    // change of S1 and S3 relative to that of S2, which is common to all three
    const double all = x.c2, one = x.c1 - all, three = x.c3 - all;
    const double a = part(3, i), b = part(4, i), c = part(5, i), d = part(9, i), e = part(10, i), f = part(11, i);
    xx[i] -= all + one * a * a + three * d * d;
    yy[i] -= all + one * b * b + three * e * e;
    zz[i] -= all + one * c * c + three * f * f;
    xy[i] -= one * a * b + three * d * e;
    yz[i] -= one * b * c + three * e * f;
    xz[i] -= one * a * c + three * d * f;
    plastic_history.add(i, S1, S2, S3, x, volume_ratio<3>(slice.points, i));
    bound[i] = here ? 0.0 : bound[i];
  }
}

inline bool any_beyond(const std::array<double, chunk>& bound, int count) {
  return *std::max_element(bound.begin(), bound.begin() + count) > 0;
}

}  // namespace tribo
