// SPDX-License-Identifier: MIT
/// Words of messages.

#include "base/text.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("nouns are in the singular after what is printed as 1, and in the plural otherwise", "[base]") {
  CHECK(counted(1, "particle") == "1 particle");
  CHECK(counted(0, "particle") == "0 particles");
  CHECK(counted(std::size_t{1234567}, "particle") == "1234567 particles");
  CHECK(counted(1.0, "cell") == "1 cell");
  CHECK(counted(0.9999, "cell") == "1 cell");
  CHECK(counted(1.04, "cell") == "1 cell");
  CHECK(counted(1.04, "cell", "%.3g") == "1.04 cells");
  CHECK(counted(0.5, "cell") == "0.5 cells");
  CHECK(counted(-1.0, "cell") == "-1 cells");
}
