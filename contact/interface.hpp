/// One step of a relative motion held by a spring: m d'' = f - k d, v = d'.
#pragma once

#include <algorithm>
#include <cmath>

namespace tribo {

/// Exact opening at the end of the step, for a constant force f = m (v_free - v0)/dt.
inline double exact_opening(double mass, double k, double d0, double v0, double v_free, double dt) {
  const double a = (v_free - v0) / dt, w = std::sqrt(std::max(k, 0.0) / mass), phi = w * dt;
  if (phi < 1e-4) {  // series, to 1e-16
    const double q = phi * phi;
    return d0 * (1 - q / 2) + v0 * dt * (1 - q / 6) + a * dt * dt / 2 * (1 - q / 12);
  }
  return d0 * std::cos(phi) + v0 * std::sin(phi) / w + a / (w * w) * (1 - std::cos(phi));
}

/// Impulse k int d dt of the exact motion.
inline double exact_impulse(double mass, double k, double d0, double v0, double v_free, double dt) {
  const double a = (v_free - v0) / dt, w = std::sqrt(std::max(k, 0.0) / mass), phi = w * dt;
  if (phi < 1e-4) {
    const double q = phi * phi;
    return k * dt * (d0 * (1 - q / 6) + v0 * dt / 2 * (1 - q / 12) + a * dt * dt / 6 * (1 - q / 20));
  }
  const double c = std::cos(phi), s = std::sin(phi);
  return mass * (d0 * w * s + v0 * (1 - c) + a * (dt - s / w));
}

/// Implicit rule with weight theta of the end: theta = 1/2 is the midpoint rule, 1 backward Euler. Stable for any k.
inline double implicit_impulse(double mass, double k, double d0, double v0, double v_free, double dt) {
  const double phi2 = k * dt * dt / mass, phi = std::sqrt(std::max(phi2, 0.0));
  const double theta = phi <= 3 ? 0.5 : 1 - 1.5 / phi;
  return dt * k * (d0 + dt * theta * ((1 - theta) * v0 + theta * v_free)) / (1 + theta * theta * phi2);
}

/// Impulse that the spring gives in a step, v_free the velocity it would end with without the spring. Exact while the
/// spring is soft against the step (phi = dt sqrt(k/m) < 1.5); beyond phi = 3, where the exact motion oscillates within
/// the step and its phase has no meaning, implicit; blended between, so there is no jump in behaviour.
inline double interface_impulse(double mass, double k, double d0, double v0, double v_free, double dt) {
  if (!(k > 0)) return 0.0;
  const double phi = dt * std::sqrt(k / mass);
  if (phi <= 1.5) return exact_impulse(mass, k, d0, v0, v_free, dt);
  const double implicit = implicit_impulse(mass, k, d0, v0, v_free, dt);
  if (phi >= 3) return implicit;
  const double x = (phi - 1.5) / 1.5;
  return (1 - x) * exact_impulse(mass, k, d0, v0, v_free, dt) + x * implicit;
}

/// Opening after `impulse` acted on the relative motion.
inline double opening_after(double mass, double d0, double v0, double v_free, double impulse, double dt) {
  return d0 + 0.5 * dt * (v0 + v_free - impulse / mass);
}

}  // namespace tribo
