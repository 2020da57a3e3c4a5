// SPDX-License-Identifier: MIT
/// One step of a relative motion against a spring: m d'' = f - k d.
///
/// The particles move with the velocities at the end of the step. So the scheme is leapfrog: openings d are those at
/// the ends of steps, velocities those in the middles, d1 = d0 + dt v1 with v1 = v_free - J/m, where v_free is the
/// velocity without the spring and J the impulse of the spring.
#pragma once

#include <algorithm>
#include <cmath>

namespace tribo {

/// Weight of the opening at the end of the step in the traction of the step, for a spring with phi = dt sqrt(k/m). It
/// is 0 (explicit) where leapfrog resolves the oscillation, and tends to 1 (backward Euler, which does not overshoot)
/// for stiff springs. The step is stable for any phi.
inline double implicit_weight(double phi) { return phi <= 1 ? 0.0 : 1 - 1 / (phi * phi); }

/// Impulse J of the spring in a step [mass velocity]; positive J reduces a positive opening.
///
/// `mass`: reduced mass [mass]; `k`: stiffness [force/length]; `d0`: opening at the start of the step [length]; `v0`:
/// relative velocity in the step before, `v_free`: in this step without the spring, so that v_free - v0 = f dt/m
/// [velocity]; `dt`: step.
///
/// For phi = dt sqrt(k/m) <= 1 the step is exact: leapfrog with c = 2 (1 - cos phi) in place of phi^2 gives the
/// openings of the exact oscillation under a constant force. For phi >= 3, where a step cannot represent the
/// oscillation, it is implicit, and tends to perfectly bonded faces as k grows. Between the two it is interpolated, so
/// that the impulse is continuous in k. The step is stable for any k.
inline double spring_impulse(double mass, double k, double d0, double v0, double v_free, double dt) {
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
