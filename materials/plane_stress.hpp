// SPDX-License-Identifier: MIT
/// The out-of-plane strain rate of plane stress, for laws without a closed form for it.
#pragma once

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {

/// Finds the out-of-plane rate for which `stress_zz(rate)` vanishes to the round-off of `modulus` [stress]. The last
/// call of `stress_zz` is made with the solution. Secant steps, restricted to a bracket once one is known; sigma_zz
/// must not decrease with the rate. Throws SimulationError if no out-of-plane strain of reasonable size makes sigma_zz
/// vanish.
template <class Function>
double out_of_plane_rate(Function&& stress_zz, double modulus, double dt) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), largest_strain = 20.0;
  const double tolerance = 1e-14 * modulus;
  double low = -infinite, high = infinite;
  double r0 = 0.0, s0 = stress_zz(r0);
  if (std::abs(s0) <= tolerance) return r0;
  (s0 < 0 ? low : high) = r0;
  double r1 = -s0 / (modulus * dt);
  for (int k = 0; k < 200; ++k) {
    const double s1 = stress_zz(r1);
    if (std::abs(s1) <= tolerance) return r1;
    (s1 < 0 ? low : high) = r1;
    const double slope = (s1 - s0) / (r1 - r0);
    const bool bracketed = std::isfinite(low) && std::isfinite(high);
    double r2 = r1 - s1 / slope;
    if (!bracketed) {  // step towards the root, but limit the step where the slope is only round-off
      const double reach = 8 * std::max(std::abs(r1 - r0), std::abs(s1) / (modulus * dt));
      if (!(slope > 0 && std::abs(r2 - r1) < reach)) r2 = r1 - std::copysign(reach, s1);
    } else if (!(r2 > low && r2 < high) || (k > 20 && k % 2)) {
      r2 = 0.5 * (low + high);
    }
    if (r2 == r1 || r2 == low || r2 == high) return r1;
    if (!(std::abs(r2) * dt < largest_strain)) break;
    r0 = r1, s0 = s1, r1 = r2;
  }
  throw SimulationError("plane stress: no out-of-plane strain makes the out-of-plane stress vanish");
}

}  // namespace tribo
