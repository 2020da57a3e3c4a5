// SPDX-License-Identifier: MIT
/// Number of output times of a run.

#include "run/trial_output.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("a run writes files at the output times and at its end", "[run]") {
  CHECK(file_times(Schedule::every(0.5), 2.0) == 5);
  CHECK(file_times(Schedule::every(0.1), 0.3) == 4);  // 3 * 0.1 exceeds 0.3 by round-off
  CHECK(file_times(Schedule::every(0.5), 2.2) == 6);
  CHECK(file_times(Schedule::every(50.0), 1.0) == 2);
  // The first output time after the end
  CHECK(file_times(Schedule({{3.0, 1.0, 0}}), 2.0) == 1);
}
