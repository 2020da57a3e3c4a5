// SPDX-License-Identifier: MIT
#include "base/error.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("a problem names file, line and column", "[base]") {
  const auto file = std::make_shared<const std::string>("deck.xml");
  const InputError error(Origin{file, 7, 3}, "no");
  REQUIRE(std::string(error.what()) == "deck.xml:7:3: error: no");
}

TEST_CASE("a similar word is suggested, a dissimilar one is not", "[base]") {
  REQUIRE(did_you_mean("Younf", {"Young", "nu"}) == " (did you mean 'Young'?)");
  REQUIRE(did_you_mean("banana", {"Young", "nu"}).empty());
}
