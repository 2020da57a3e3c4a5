// SPDX-License-Identifier: MIT
/// CPU time of this process, and times of steps.
#pragma once

#include <chrono>
#include <cstddef>
#include <ctime>

namespace tribo {

/// Of all threads together [s].
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of one step of one particle [ns].
struct Times {
  double cpu = 0.0, wall = 0.0;
  Times& operator+=(const Times& other) {
    cpu += other.cpu, wall += other.wall;
    return *this;
  }
  friend Times operator/(const Times& t, double by) { return {t.cpu / by, t.wall / by}; }
};

/// Takes `steps` steps of length `dt` and returns the times of one step of one of `particles`.
template <class Stepper>
Times cost_of_steps(Stepper& stepper, std::size_t particles, int steps, double dt = 0.25) {
  const double cpu = cpu_seconds(), wall = wall_seconds();
  for (int k = 0; k < steps; ++k) stepper.advance(dt);
  const double per_step = 1e9 / (static_cast<double>(particles) * steps);
  return {per_step * (cpu_seconds() - cpu), per_step * (wall_seconds() - wall)};
}

}  // namespace tribo
