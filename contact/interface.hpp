// SPDX-License-Identifier: MIT
/// One step of a relative motion held by a spring: m d'' = f - k d.
///
/// The particles move with the velocities of the step's end, so openings belong to the ends of steps and velocities to
/// their middles (leapfrog): d1 = d0 + dt v1, v1 = v_free - J/m, v_free the velocity without the spring.
#pragma once

#include <algorithm>
#include <cmath>

namespace tribo {

/// Weight of the opening of the step's end in the traction of a spring with phi = dt sqrt(k/m): 0 where leapfrog
/// resolves the oscillation, growing to 1 (backward Euler, which closes without overshoot). Stable for any phi.
inline double implicit_weight(double phi) { return phi <= 1 ? 0.0 : 1 - 1 / (phi * phi); }

/// Impulse that the spring gives in a step; v0 is the velocity of the step before, v_free - v0 = f dt/m.
///
/// phi <= 1: exact. Leapfrog with the factor c = 2 (1 - cos phi) in place of phi^2 runs through the openings of the
/// exact oscillation under a constant force. phi >= 3, where the oscillation has no meaning any more: implicit, and
/// the faces join as k grows. Blended between, so there is no jump in behaviour. Stable for any k.
inline double interface_impulse(double mass, double k, double d0, double v0, double v_free, double dt) {
  if (!(k > 0)) return 0.0;
  const double phi2 = k * dt * dt / mass, phi = std::sqrt(phi2);
  const auto exact = [&] {
    const double half = std::sin(0.5 * phi), c = 4 * half * half;
    return mass * (c * d0 / dt + (v_free - v0) * (phi < 1e-3 ? phi2 / 12 : 1 - c / phi2));
  };
  const auto implicit = [&] {
    const double beta = implicit_weight(phi);
    return dt * k * (d0 + beta * dt * v_free) / (1 + beta * phi2);
  };
  if (phi <= 1) return exact();
  if (phi >= 3) return implicit();
  const double x = 0.5 * (phi - 1);
  return (1 - x) * exact() + x * implicit();
}

}  // namespace tribo
