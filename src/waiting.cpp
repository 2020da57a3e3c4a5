// SPDX-License-Identifier: MIT
/// Before anything else runs: threads that have done their share shall spin for a moment only, then sleep. Left alone,
/// libgomp lets them spin for milliseconds; where other programs want the same cores, that costs a thread its turn at
/// every barrier, and runs crawl.

#include <cstdlib>

#include <sys/auxv.h>
#include <unistd.h>

namespace {

// About 0.1 ms: longer than the barriers of a step on free cores take.
constexpr const char* spins = "3000";

// The variable is read when libgomp is loaded, so the program starts anew with it; whoever has set it, or the policy,
// is left alone.
__attribute__((constructor(101))) void wait_briefly(int, char** arguments, char**) {
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  if (getauxval(AT_BASE) == 0) return;  // started by the loader's own name: that is what would start anew
  if (setenv("GOMP_SPINCOUNT", spins, 1) == 0) execv("/proc/self/exe", arguments);  // returns only if it cannot
}

}  // namespace
