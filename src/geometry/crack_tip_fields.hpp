// SPDX-License-Identifier: MIT
/// Asymptotic fields at a crack tip in a plane isotropic elastic body.
#pragma once

#include "base/types.hpp"

#include <cmath>
#include <numbers>

namespace tribo {

/// Stress and displacement gradient u_i,j. The crack lies along the negative x axis, its tip at the origin.
struct TipField {
  Mat<2> stress, gradient;
};

/// Fields per unit stress intensity factor: mode 1 opening, mode 2 sliding. `angle` from -pi to pi; `G`: shear modulus;
/// `kappa`: 3 - 4 nu in plane strain, (3 - nu)/(1 + nu) in plane stress. Williams, J. Appl. Mech. 24 (1957) 109-114.
inline TipField tip_field(int mode, double r, double angle, double G, double kappa) {
  const double f = 1 / std::sqrt(2 * std::numbers::pi * r);
  const double s = std::sin(0.5 * angle), c = std::cos(0.5 * angle);
  const double s3 = std::sin(1.5 * angle), c3 = std::cos(1.5 * angle);
  double xx, yy, xy, turn;
  if (mode == 1)
    xx = c * (1 - s * s3), yy = c * (1 + s * s3), xy = s * c * c3, turn = -s;
  else
    xx = -s * (2 + c * c3), yy = s * c * c3, xy = c * (1 - s * s3), turn = -c;
  TipField out;
  out.stress << xx, xy, xy, yy;
  out.stress *= f;
  // Hooke's law in the plane; the rotation is (kappa + 1)/(2 G) times the imaginary part of Muskhelishvili's phi'.
  out.gradient = (out.stress - 0.25 * (3 - kappa) * out.stress.trace() * Mat<2>::Identity()) / (2 * G);
  const double rotation = (kappa + 1) / (4 * G) * f * turn;
  out.gradient(0, 1) -= rotation, out.gradient(1, 0) += rotation;
  return out;
}

}  // namespace tribo
