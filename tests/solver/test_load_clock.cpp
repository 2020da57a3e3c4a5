// SPDX-License-Identifier: MIT
/// The time of loads that go back or stop.

#include "solver/state/load_clock.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("the load time follows the time until a value is passed", "[clock]") {
  std::optional<LoadReversal> reversal;
  LoadClock clock;
  CHECK(clock.at(3, reversal) == 3);
  reversal = LoadReversal{0, 10.0, LoadReversal::Style::reverse, 0.0, {}, {}};
  CHECK_FALSE(clock.look(9, 1, *reversal));
  CHECK(clock.at(3, reversal) == 3);
  CHECK(clock.rate(3, reversal) == 1);
  CHECK(clock.look(10, 4, *reversal));
  CHECK_FALSE(clock.look(8, 5, *reversal));  // only once
  CHECK(clock.turned == 4);
  CHECK(clock.at(4, reversal) == 4);
  CHECK(clock.at(5, reversal) == 3);
  CHECK(clock.at(9, reversal) == 0);
  CHECK(clock.rate(5, reversal) == -1);
  CHECK(clock.rate(8, reversal) == 0);
  CHECK(clock.end_of_run(100, reversal) == 8);
  CHECK(clock.end_of_run(6, reversal) == 6);
  reversal->style = LoadReversal::Style::hold;
  CHECK(clock.at(5, reversal) == 4);
  CHECK(clock.rate(5, reversal) == 0);
  CHECK(clock.end_of_run(100, reversal) == 100);
  reversal->style = LoadReversal::Style::stop;
  CHECK(clock.end_of_run(100, reversal) == 4);
}

TEST_CASE("a value may be passed downwards", "[clock]") {
  const LoadReversal reversal{0, -2.0, LoadReversal::Style::stop, 0.0, {}, {}};
  LoadClock clock;
  CHECK_FALSE(clock.look(-3, 0, reversal));  // where it was before is not known
  CHECK_FALSE(clock.look(-4, 1, reversal));
  CHECK(clock.look(-1, 2, reversal));
}

TEST_CASE("loads may be held before they go back, and the run may end on the way", "[clock]") {
  LoadReversal what{0, 10.0, LoadReversal::Style::reverse, 2.0, 6.0, {}};
  LoadClock clock;
  clock.look(0, 0, what);
  CHECK(clock.look(11, 5, what));
  const std::optional<LoadReversal> reversal = what;
  CHECK(clock.at(6, reversal) == 5);
  CHECK(clock.rate(6, reversal) == 0);
  CHECK(clock.at(8, reversal) == 4);
  CHECK(clock.rate(8, reversal) == -1);
  CHECK(clock.end_of_run(100, reversal) == 12);
  CHECK_FALSE(clock.look(5, 6, what));  // the loads are held: this does not count
  CHECK(clock.end_of_run(100, reversal) == 12);
  clock.look(11, 7, what);
  clock.look(7, 8, what);
  clock.look(5, 9, what);
  CHECK(clock.end_of_run(100, reversal) == 9);
  clock.look(7, 9.5, what);
  CHECK(clock.end_of_run(100, reversal) == 9);
}

TEST_CASE("the length of a crack may end its growth and leave the loads as they are", "[clock]") {
  LoadReversal reversal;
  reversal.style = LoadReversal::Style::none, reversal.crack = 0;
  LoadClock clock;
  CHECK_FALSE(clock.is_arrested(reversal));
  clock.turned = 3;
  CHECK(clock.is_arrested(reversal));
  CHECK(clock.at(5, reversal) == 5);
  CHECK(clock.rate(5, reversal) == 1);
  CHECK(clock.end_of_run(100, reversal) == 100);
}
