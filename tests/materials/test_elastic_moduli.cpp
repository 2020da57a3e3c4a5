// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

TEST_CASE("elastic moduli are determined from the stresses of a law", "[materials]") {
  const Properties elastic{{"rho", "2"}, {"E", "1000"}, {"nu", "0.3"}};
  const std::unique_ptr<Material> laws[] = {
      make_material("LinearElastic", elastic),
      make_material("IsoPlasticity", {{"rho", "2"}, {"E", "1000"}, {"nu", "0.3"}, {"yield", "10"}})};
  for (const auto& law : laws) {
    const auto moduli = elastic_moduli(*law);
    REQUIRE(moduli);
    CHECK(moduli->G == Approx(1000 / 2.6).epsilon(1e-5));
    CHECK(moduli->nu == Approx(0.3).epsilon(1e-5));
    CHECK(moduli->E() == Approx(1000).epsilon(1e-5));
  }
  CHECK_FALSE(elastic_moduli(*make_material("TaitLiquid", {{"rho", "1"}, {"K", "2000"}, {"viscosity", "1"}})));
}
