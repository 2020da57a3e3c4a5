// SPDX-License-Identifier: MIT
#include "particles/seeds.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tribo;

TEST_CASE("initial particles are read as they were given, in order and by number", "[fill]") {
  std::mt19937 random(3);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<Seed> given;
  Seed seed;
  for (int k = 0; k < 400; ++k) {
    seed.x = Vec3(k, draw(5), 0);
    // every group of quantities changes at times of its own, and may return to a former value
    if (draw(4) == 0) seed.v = Vec3(draw(3), 0, 0);
    if (draw(9) == 0) seed.stress(0, 1) = draw(2);
    if (draw(6) == 0) seed.volume = 1 + draw(2), seed.mass = 2 * draw(3);
    if (draw(20) == 0) seed.half_axes = draw(2) == 0 ? std::optional<Mat3>() : Mat3(draw(2) * Mat3::Identity());
    if (draw(20) == 0) seed.F(1, 1) = 1 + draw(2), seed.piece = draw(2), seed.material = draw(2);
    given.push_back(seed);
  }
  Seeds seeds;
  for (const Seed& s : given) seeds.push_back(s);
  REQUIRE(seeds.size() == given.size());
  std::size_t k = 0;
  for (const Seed& s : seeds) {
    CHECK(s == given[k]);
    CHECK(seeds[k] == given[k]);
    ++k;
  }
  CHECK(k == given.size());
  CHECK(std::count_if(seeds.begin(), seeds.end(), [](const Seed& s) { return s.material == 1; }) ==
        std::count_if(given.begin(), given.end(), [](const Seed& s) { return s.material == 1; }));
}

TEST_CASE("no initial particles", "[fill]") {
  const Seeds none;
  CHECK(none.empty());
  CHECK(none.begin() == none.end());
}
