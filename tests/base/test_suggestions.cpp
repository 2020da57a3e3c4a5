// SPDX-License-Identifier: MIT
/// What messages suggest in place of a wrong word.

#include "base/error.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("a wrong word is compared with the known ones", "[base]") {
  const std::vector<std::string> elements{"Hole", "Joint", "Body", "Stage"}, names{"rock", "block", "x"};
  CHECK(did_you_mean("Jiont", elements) == " (did you mean 'Joint'?)");  // exchanged letters
  CHECK(did_you_mean("rokc", names) == " (did you mean 'rock'?)");
  CHECK(did_you_mean("Bdy", elements) == " (did you mean 'Body'?)");
  CHECK(did_you_mean("stagge", elements) == " (did you mean 'Stage'?)");
  CHECK(did_you_mean("hale", elements) == " (did you mean 'Hole'?)");
  CHECK(did_you_mean("X", names) == " (did you mean 'x'?)");
  CHECK(did_you_mean("y", names).empty());
  CHECK(did_you_mean("Oval", elements).empty());
  CHECK(did_you_mean("", elements).empty());
}
