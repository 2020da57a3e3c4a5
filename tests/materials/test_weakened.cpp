// SPDX-License-Identifier: MIT
#include "tests/material_point.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

// Angle of which the tangent is that of `degrees` over the factor.
std::string angle(double degrees, double factor) {
  constexpr double pi = std::numbers::pi;
  return text(std::atan(std::tan(degrees * pi / 180) / factor) * 180 / pi);
}

// Shear, then stretch, far beyond yield.
Mat3 weakened_stress(const Material& law) {
  MaterialPoint<3> point(law);
  Mat3 L = Mat3::Zero();
  for (int k = 0; k < 50; ++k) {
    L(0, 1) = 1e-4, L(1, 1) = k < 30 ? -2e-4 : 2e-4, L(2, 0) = 5e-5;
    point.step(L, 1.0);
  }
  return point.stress;
}

void check_same(const std::string& type, const Properties& strong, const Properties& weak) {
  const auto law = make_material(type, strong);
  const auto weakened = law->weakened(1.7);
  REQUIRE(weakened);
  const Mat3 wanted = weakened_stress(*make_material(type, weak));
  CHECK((weakened_stress(*weakened) - wanted).norm() < 1e-12 * wanted.norm());
  CHECK((weakened_stress(*law) - wanted).norm() > 0.05 * wanted.norm());
  CHECK((weakened_stress(*law->weakened(1.0)) - weakened_stress(*law)).norm() < 1e-12 * wanted.norm());
}

}  // namespace

TEST_CASE("a weakened law is the law with weaker properties", "[materials]") {
  const Properties elastic{{"rho", "1"}, {"K", "2e8"}, {"G", "2e8"}};
  const double f = 1.7;
  check_same("MohrCoulomb",
             with(elastic, {{"cohesion", "1e5"}, {"friction", "30"}, {"dilation", "25"}, {"tension", "4e4"}}),
             with(elastic, {{"cohesion", text(1e5 / f)},
                            {"friction", angle(30, f)},
                            {"dilation", angle(30, f)},  // 25 degrees would exceed it
                            {"tension", text(4e4 / f)}}));
  const Properties softens{{"softening_end", "0.002"}, {"dilation", "5"}};
  check_same("MohrCoulomb",
             with(with(elastic, softens),
                  {{"cohesion", "1e5"}, {"friction", "30"}, {"cohesion_residual", "2e4"}, {"friction_residual", "20"}}),
             with(with(elastic, softens), {{"cohesion", text(1e5 / f)},
                                           {"friction", angle(30, f)},
                                           {"cohesion_residual", text(2e4 / f)},
                                           {"friction_residual", angle(20, f)}}));
  for (const char* match : {"1", "2", "3", "4"})
    check_same(
        "DruckerPrager", with(elastic, {{"cohesion", "1e5"}, {"friction", "30"}, {"dilation", "5"}, {"match", match}}),
        with(elastic, {{"cohesion", text(1e5 / f)}, {"friction", angle(30, f)}, {"dilation", "5"}, {"match", match}}));
  check_same("IsoPlasticity", with(elastic, {{"yield", "2e5"}, {"Khard", "1e7"}}),
             with(elastic, {{"yield", text(2e5 / f)}, {"Khard", text(1e7 / f)}}));
  check_same(
      "IsoPlasticity", with(elastic, {{"Hardening", "JohnsonCook"}, {"Ajc", "2e5"}, {"Bjc", "1e6"}, {"njc", "0.5"}}),
      with(elastic, {{"Hardening", "JohnsonCook"}, {"Ajc", text(2e5 / f)}, {"Bjc", text(1e6 / f)}, {"njc", "0.5"}}));
}

TEST_CASE("laws without strength cannot be weakened", "[materials]") {
  CHECK_FALSE(make_material("LinearElastic", {{"rho", "1"}, {"E", "1"}, {"nu", "0.3"}})->weakened(2.0));
}
