// SPDX-License-Identifier: MIT
/// CPU time of this process, and of steps.
#pragma once

#include <cstddef>
#include <ctime>

namespace tribo {

/// Of all threads together [s].
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Takes `steps` steps of 0.25 and returns the CPU time of one step of one of `particles` [ns].
template <class Stepper>
double cost_of_steps(Stepper& stepper, std::size_t particles, int steps) {
  const double start = cpu_seconds();
  for (int k = 0; k < steps; ++k) stepper.advance(0.25);
  return 1e9 * (cpu_seconds() - start) / (static_cast<double>(particles) * steps);
}

}  // namespace tribo
