// SPDX-License-Identifier: MIT
#include "materials/elastic.hpp"

namespace tribo {
namespace {

// Rotations per step above this angle [rad] exceed the range of the series in the fast loops.
constexpr double small_angle = 0.1;

// By value: std::max returns references, which the compiler vectorises to gathers.
double larger(double a, double b) { return a > b ? a : b; }

// Series for small angles, |t| <= small_angle.
inline void sine_cosine(double t, double& sine, double& cosine) {
  const double q = t * t;
  sine = t * sine_over_angle(q);
  cosine = 1 - q * (1.0 / 2 - q * (1.0 / 24 - q * (1.0 / 720 - q * (1.0 / 40320))));
}

}  // namespace

template <>
void elastic_step<2>(const MaterialPoints<2>& points, const Elasticity& elastic) {
  const double dt = points.dt, lambda = elastic.lambda, mu = elastic.mu;
  const double* __restrict Lxx = points.L[0];
  const double* __restrict Lxy = points.L[1];
  const double* __restrict Lyx = points.L[2];
  const double* __restrict Lyy = points.L[3];
  double* __restrict Lzz = points.L[4];
  double* __restrict xx = points.stress[0];
  double* __restrict yy = points.stress[1];
  double* __restrict zz = points.stress[2];
  double* __restrict xy = points.stress[3];

  if (points.plane_stress) {
    double* __restrict Fzz = points.F[4];
    double* __restrict volume = points.volume;
    const double ratio = -lambda / (lambda + 2 * mu);
    for (int i = 0; i < points.count; ++i) {
      Lzz[i] = ratio * (Lxx[i] + Lyy[i]);
      const double stretch = std::exp(Lzz[i] * dt);
      if (Fzz) Fzz[i] *= stretch;
      volume[i] *= stretch;
    }
  }

  double most = 0.0;
#pragma omp simd reduction(max : most)
  for (int i = 0; i < points.count; ++i) most = larger(most, std::abs(Lyx[i] - Lxy[i]));
  const bool small = 0.5 * most * dt < small_angle;

  // (xx - yy)/2 and xy rotate by twice the rotation angle of the body
  const auto update = [&](int i, double sine, double cosine) {
    const double sine2 = 2 * sine * cosine, cosine2 = 1 - 2 * sine * sine;
    const double trace = dt * (Lxx[i] + Lyy[i] + Lzz[i]);
    const double ds = dt * mu * (Lxx[i] - Lyy[i]), dxy = dt * mu * (Lxy[i] + Lyx[i]);
    const double mean = 0.5 * (xx[i] + yy[i]) + lambda * trace + dt * mu * (Lxx[i] + Lyy[i]);
    const double s = 0.5 * (xx[i] - yy[i]), t = xy[i];
    const double s_new = cosine2 * s - sine2 * t + cosine * ds - sine * dxy;
    xy[i] = sine2 * s + cosine2 * t + sine * ds + cosine * dxy;
    xx[i] = mean + s_new;
    yy[i] = mean - s_new;
    zz[i] += lambda * trace + 2 * mu * dt * Lzz[i];
  };

  if (small) {
#pragma omp simd
    for (int i = 0; i < points.count; ++i) {
      double sine, cosine;
      sine_cosine(0.5 * dt * (Lyx[i] - Lxy[i]), sine, cosine);
      update(i, sine, cosine);
    }
  } else {
    for (int i = 0; i < points.count; ++i) {
      const double angle = 0.5 * dt * (Lyx[i] - Lxy[i]);
      update(i, std::sin(angle), std::cos(angle));
    }
  }
}

template <>
void elastic_step<3>(const MaterialPoints<3>& points, const Elasticity& elastic) {
  const double dt = points.dt, lambda = elastic.lambda, mu = elastic.mu;
  const auto& L = points.L;
  const double* __restrict Lxx = L[0];
  const double* __restrict Lxy = L[1];
  const double* __restrict Lxz = L[2];
  const double* __restrict Lyx = L[3];
  const double* __restrict Lyy = L[4];
  const double* __restrict Lyz = L[5];
  const double* __restrict Lzx = L[6];
  const double* __restrict Lzy = L[7];
  const double* __restrict Lzz = L[8];
  double* __restrict sxx = points.stress[0];
  double* __restrict syy = points.stress[1];
  double* __restrict szz = points.stress[2];
  double* __restrict sxy = points.stress[3];
  double* __restrict syz = points.stress[4];
  double* __restrict sxz = points.stress[5];

  double most = 0.0;
#pragma omp simd reduction(max : most)
  for (int i = 0; i < points.count; ++i)
    most =
        larger(most, larger(std::abs(Lzy[i] - Lyz[i]), larger(std::abs(Lxz[i] - Lzx[i]), std::abs(Lyx[i] - Lxy[i]))));
  const bool small = most * dt < small_angle;

  // Half of the rotation is applied before the strain increment, half after it.
  const auto update = [&](int i, double a, double b, double x, double y, double z) {
    const double q00 = 1 - b * (y * y + z * z), q01 = b * x * y - a * z, q02 = b * x * z + a * y;
    const double q10 = b * x * y + a * z, q11 = 1 - b * (x * x + z * z), q12 = b * y * z - a * x;
    const double q20 = b * x * z - a * y, q21 = b * y * z + a * x, q22 = 1 - b * (x * x + y * y);
    double xx = sxx[i], yy = syy[i], zz = szz[i], xy = sxy[i], yz = syz[i], xz = sxz[i];
    const auto rotate = [&] {
      const double m00 = q00 * xx + q01 * xy + q02 * xz, m01 = q00 * xy + q01 * yy + q02 * yz,
                   m02 = q00 * xz + q01 * yz + q02 * zz;
      const double m10 = q10 * xx + q11 * xy + q12 * xz, m11 = q10 * xy + q11 * yy + q12 * yz,
                   m12 = q10 * xz + q11 * yz + q12 * zz;
      const double m20 = q20 * xx + q21 * xy + q22 * xz, m21 = q20 * xy + q21 * yy + q22 * yz,
                   m22 = q20 * xz + q21 * yz + q22 * zz;
      xx = m00 * q00 + m01 * q01 + m02 * q02;
      yy = m10 * q10 + m11 * q11 + m12 * q12;
      zz = m20 * q20 + m21 * q21 + m22 * q22;
      xy = m00 * q10 + m01 * q11 + m02 * q12;
      yz = m10 * q20 + m11 * q21 + m12 * q22;
      xz = m00 * q20 + m01 * q21 + m02 * q22;
    };
    rotate();
    const double volumetric = dt * lambda * (Lxx[i] + Lyy[i] + Lzz[i]), two_mu = 2 * mu * dt, shear = mu * dt;
    xx += volumetric + two_mu * Lxx[i];
    yy += volumetric + two_mu * Lyy[i];
    zz += volumetric + two_mu * Lzz[i];
    xy += shear * (Lxy[i] + Lyx[i]);
    yz += shear * (Lyz[i] + Lzy[i]);
    xz += shear * (Lxz[i] + Lzx[i]);
    rotate();
    sxx[i] = xx, syy[i] = yy, szz[i] = zz, sxy[i] = xy, syz[i] = yz, sxz[i] = xz;
  };

  const double quarter = 0.25 * dt;  // half of the rotation vector (curl v)/2 dt
  if (small) {
#pragma omp simd
    for (int i = 0; i < points.count; ++i) {
      const double x = quarter * (Lzy[i] - Lyz[i]), y = quarter * (Lxz[i] - Lzx[i]), z = quarter * (Lyx[i] - Lxy[i]);
      const double q = x * x + y * y + z * z;
      update(i, sine_over_angle(q), versine_over_square(q), x, y, z);
    }
  } else {
    for (int i = 0; i < points.count; ++i) {
      const double x = quarter * (Lzy[i] - Lyz[i]), y = quarter * (Lxz[i] - Lzx[i]), z = quarter * (Lyx[i] - Lxy[i]);
      const auto [a, b] = rotation_coefficients(x * x + y * y + z * z);
      update(i, a, b, x, y, z);
    }
  }
}

}  // namespace tribo
