// SPDX-License-Identifier: MIT
/// Which trials of a search for a factor of safety hold.

#include "run/safety.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using Catch::Contains;

namespace {

Settlement settlement(double late, double at_end, const char* failure = "") {
  Settlement s;
  s.late = late, s.at_end = at_end, s.failure = failure;
  return s;
}

}  // namespace

TEST_CASE("a trial slips if it still moves at the end, or if its run failed", "[safety]") {
  CHECK(judged(1, settlement(1, 1.04), 0.05, {}).holds);
  CHECK(judged(1, settlement(0, 0), 0.05, {}).holds);
  CHECK_FALSE(judged(1, settlement(1, 1.06), 0.05, {}).holds);
  CHECK_FALSE(judged(1, settlement(1, 1, "left the grid"), 0.05, {}).holds);
  CHECK(judged(1, settlement(1, 1, "left the grid"), 0.05, {}).failure == "left the grid");
}

TEST_CASE("a trial that came to rest after a collapse slips", "[safety]") {
  std::vector<SafetyTrial> before{judged(1, settlement(0.06, 0.06), 0.05, {})};
  CHECK(judged(2, settlement(0.29, 0.29), 0.05, before).holds);
  const SafetyTrial closed = judged(2, settlement(0.61, 0.61), 0.05, before);
  CHECK_FALSE(closed.holds);
  CHECK_THAT(closed.failure, Contains("10.2 times that with strengths over 1,"));
  before.push_back(closed);
  before.push_back(judged(1.5, settlement(0.2, 0.2), 0.05, before));
  // The smallest factor that holds is the reference, not the latest one, nor one above the trial.
  CHECK_FALSE(judged(1.6, settlement(0.31, 0.31), 0.05, before).holds);
  CHECK(judged(0.9, settlement(0.31, 0.31), 0.05, before).holds);
}
