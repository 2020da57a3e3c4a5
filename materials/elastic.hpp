// SPDX-License-Identifier: MIT
/// Common parts of hypoelastic laws: Hooke's law, the objective rotation and the elastic step of a batch.
#pragma once

#include "materials/material.hpp"

#include <cmath>

namespace tribo {

/// Isotropic elasticity, Lame constants [stress].
struct Elasticity {
  double lambda = 0, mu = 0;

  static Elasticity young(double E, double nu) { return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))}; }
  static Elasticity bulk_shear(double K, double G) { return {K - 2.0 / 3.0 * G, G}; }
  double bulk() const { return lambda + 2.0 / 3.0 * mu; }
  double wave_modulus() const { return lambda + 2 * mu; }

  /// Stored energy per volume of a stress: sigma : C^-1 : sigma / 2 [stress].
  double energy(const Mat3& s) const {
    const double p = s.trace() / 3.0;
    return p * p / (2 * bulk()) + ((s - p * Mat3::Identity()).squaredNorm()) / (4 * mu);
  }
};

/// Coefficients of the rotation exp(W) = 1 + a W + b W^2, as functions of the squared angle.
struct RotationCoefficients {
  double a, b;
};

/// sin(t)/t for q = t^2 < 0.01, to round-off. Only products: a division takes as long as ten of them.
inline double sine_over_angle(double q) {
  return 1 - q * (1.0 / 6 - q * (1.0 / 120 - q * (1.0 / 5040 - q * (1.0 / 362880))));
}
/// (1 - cos t)/t^2 for q = t^2 < 0.01, to round-off.
inline double versine_over_square(double q) {
  return 0.5 - q * (1.0 / 24 - q * (1.0 / 720 - q * (1.0 / 40320 - q * (1.0 / 3628800))));
}

/// a = sin(t)/t and b = (1 - cos t)/t^2 for any t^2 = `square`.
inline RotationCoefficients rotation_coefficients(double square) {
  if (square < 0.01) return {sine_over_angle(square), versine_over_square(square)};
  const double angle = std::sqrt(square);
  return {std::sin(angle) / angle, (1 - std::cos(angle)) / square};
}

/// exp(W dt), W the skew part of the velocity gradient L.
inline Mat3 spin_rotation(const Mat3& L, double dt) {
  const Mat3 W = 0.5 * dt * (L - L.transpose());
  const auto [a, b] = rotation_coefficients(W(2, 1) * W(2, 1) + W(0, 2) * W(0, 2) + W(1, 0) * W(1, 0));
  return Mat3::Identity() + a * W + b * W * W;
}

/// sigma <- Q sigma Q^T + Q^(1/2) (C : D dt) Q^(1/2)T for every point, Q = exp(W dt): Jaumann rate, second order in dt,
/// objective for any rotation per step. In plane stress it also sets the out-of-plane strain for which sigma_zz = 0.
template <int Dim>
void elastic_step(const MaterialPoints<Dim>& points, const Elasticity& elastic);

/// The same update for one point, without plane stress.
inline Mat3 elastic_trial(const Elasticity& elastic, const Motion& motion, const Mat3& old) {
  const Mat3 half = spin_rotation(motion.L, 0.5 * motion.dt);
  const Mat3 D = 0.5 * motion.dt * (motion.L + motion.L.transpose());
  return half * (half * old * half.transpose() + elastic.lambda * D.trace() * Mat3::Identity() + 2 * elastic.mu * D) *
         half.transpose();
}

}  // namespace tribo
