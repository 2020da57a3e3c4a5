// SPDX-License-Identifier: MIT
#include "base/error.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("a problem names file, line and column", "[base]") {
  const auto file = std::make_shared<const std::string>("deck.xml");
  const InputError error(Origin{file, 7, 3}, "no");
  REQUIRE(std::string(error.what()) == "deck.xml:7:3: error: no");
}

TEST_CASE("a message shows what is no text as a question mark, and is cut", "[base]") {
  const auto told = [](const std::string& message) { return std::string(InputError(Origin{}, message).what()); };
  CHECK(told("no 'na\xC3\xAFve \xFF\x1B'\nand more") ==
        "error: no 'na\xC3\xAFve ?"
        "?'\nand more");
  CHECK(told(std::string(20000, 'x')).size() < 8100);
  CHECK(told("no '" + std::string(1000, 'x') + "' here").size() < 100);
}

TEST_CASE("a similar word is suggested, a dissimilar one is not", "[base]") {
  REQUIRE(did_you_mean("Younf", {"Young", "nu"}) == " (did you mean 'Young'?)");
  REQUIRE(did_you_mean("banana", {"Young", "nu"}).empty());
}
