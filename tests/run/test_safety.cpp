// SPDX-License-Identifier: MIT
#include "run/safety.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using Catch::Contains;

TEST_CASE("a model that holds only after a large displacement is doubted", "[run]") {
  Safety safety;
  CHECK(doubt_about(safety).empty());
  safety.trials = {{1.0, 0.01, 0.01, true, ""}, {2.0, 1.0, 2.0, false, ""}, {1.5, 0.05, 0.05, true, ""}};
  CHECK(doubt_about(safety).empty());
  safety.trials.push_back({1.75, 0.3, 0.3, true, ""});
  CHECK_THAT(doubt_about(safety),
             Contains("with strengths over 1.75 the model came to rest after a displacement of 0.3"));
  CHECK_THAT(doubt_about(safety), Contains("30 times that with strengths over 1"));
}
