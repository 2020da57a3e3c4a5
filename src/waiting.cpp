// SPDX-License-Identifier: MIT
/// Runs before all other code. Threads that wait at a barrier of OpenMP shall spin only briefly and then sleep. By
/// default libgomp lets them spin for milliseconds. If other programs use the same cores, this delays the threads that
/// still work, at every barrier.

#include <cstdlib>

#include <sys/auxv.h>
#include <unistd.h>

namespace {

// About 0.1 ms, which exceeds the waiting time at the barriers of a step on free cores.
constexpr const char* spins = "3000";

// The variable is read when libgomp is loaded, so the program restarts itself after setting it. A setting of the user
// is respected.
__attribute__((constructor(101))) void wait_briefly(int, char** arguments, char**) {
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  if (getauxval(AT_BASE) == 0)
    return;  // started through the loader: /proc/self/exe would restart the loader instead of the program
  if (setenv("GOMP_SPINCOUNT", spins, 1) == 0) execv("/proc/self/exe", arguments);  // returns only if it cannot
}

}  // namespace
