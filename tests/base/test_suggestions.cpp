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

TEST_CASE("a known word that is a part of a wrong one or begins with it is suggested", "[base]") {
  const std::vector<std::string> names{"friction", "velocity", "volume", "volume_ratio", "rho"};
  CHECK(did_you_mean("FrictionAngle", names) == " (did you mean 'friction'?)");
  CHECK(did_you_mean("volume_ratio_of_all", names) == " (did you mean 'volume_ratio'?)");
  CHECK(did_you_mean("vel", names) == " (did you mean 'velocity'?)");
  CHECK(did_you_mean("vol", names) == " (did you mean 'volume'?)");
  CHECK(did_you_mean("v", names).empty());
  CHECK(did_you_mean("rhodium", names).empty());  // too short a part
  CHECK(similar_word("frictionangle", names).empty());
  CHECK(similar_word("volum", names) == "volume");
}
