// SPDX-License-Identifier: MIT
/// CPU time of this process.
#pragma once

#include <ctime>

namespace tribo {

/// Of all threads together [s].
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace tribo
