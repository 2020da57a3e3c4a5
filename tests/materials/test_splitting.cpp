// SPDX-License-Identifier: MIT
#include "tests/material_point.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

Mat3 stress_after(const Material& law, const Mat3& strain, int steps) {
  MaterialPoint<3> point(law);
  for (int k = 0; k < steps; ++k) point.step(strain, 1.0 / steps);
  return point.stress;
}

}  // namespace

// On straight paths with fixed axes the return ends where its faces (or the ray of the deviator) meet the trial stress,
// however often it was called on the way: backward Euler is exact there. Not so at a tension cut-off, where a path may
// leave the face on which it first flowed.
TEST_CASE("straight strain paths may be split into steps of any size", "[materials]") {
  const Properties elastic{{"rho", "1"}, {"K", "2e8"}, {"G", "1.2e8"}};
  const std::pair<const char*, Properties> laws[] = {
      {"MohrCoulomb", {{"cohesion", "1e5"}, {"friction", "30"}, {"dilation", "10"}}},
      {"MohrCoulomb", {{"cohesion", "1e5"}, {"friction", "0"}}},
      {"DruckerPrager", {{"cohesion", "1e5"}, {"friction", "30"}, {"dilation", "10"}}},
      {"IsoPlasticity", {{"yield", "1e5"}}},
      {"IsoPlasticity", {{"yield", "1e5"}, {"Khard", "3e7"}}},
      {"IsoPlasticity", {{"Hardening", "Nonlinear"}, {"yield", "1e5"}, {"Khard", "400"}, {"nhard", "0.3"}}}};
  const auto index = GENERATE(range(0, 6));
  auto [type, properties] = laws[index];
  properties.insert(properties.end(), elastic.begin(), elastic.end());
  const auto law = make_material(type, properties);
  INFO("law " << index << ", " << type);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int path = 0; path < 300; ++path) {
    Mat3 strain = Vec3(normal(random), normal(random), normal(random)).asDiagonal();
    strain *= 3e-3;
    const Mat3 once = stress_after(*law, strain, 1);
    for (const int steps : {2, 7, 50})
      REQUIRE((stress_after(*law, strain, steps) - once).norm() < 1e-9 * (once.norm() + 1e5));
  }
}
