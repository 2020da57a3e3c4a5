// SPDX-License-Identifier: MIT
#include "materials/pressure_shear.hpp"
#include "random_path.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

std::unique_ptr<Material> cone(const char* match, const char* dilation, const char* friction = "30") {
  return make_material("DruckerPrager", {{"rho", "1"},
                                         {"K", "2e8"},
                                         {"G", "2e8"},
                                         {"cohesion", "1e6"},
                                         {"friction", friction},
                                         {"dilation", dilation},
                                         {"match", match}});
}

// Isochoric shear without rotation.
MaterialPoint<3> sheared(const Material& law, double gamma, int steps) {
  MaterialPoint<3> point(law);
  Mat3 D = Mat3::Zero();
  D(0, 1) = D(1, 0) = 0.5 * gamma / steps;
  for (int k = 0; k < steps; ++k) point.step(D, 1.0);
  return point;
}

}  // namespace

TEST_CASE("shear strength of Drucker and Prager's cones", "[materials]") {
  // c = 1 MPa, phi = 30 degrees, psi = 0, no pressure
  const std::pair<const char*, double> table[] = {{"1", 1.2e6},
                                                  {"2", 6 / 3.5 * 0.5e6},
                                                  {"3", 3 * std::sqrt(0.75) / std::sqrt(3.25) / std::sqrt(3.0) * 1e6},
                                                  {"4", std::sqrt(0.75) * 1e6}};
  for (const auto& [match, strength] : table)
    for (const int steps : {1, 20}) {
      INFO(match);
      CHECK(sheared(*cone(match, "0"), 0.02, steps).stress(0, 1) == Approx(strength).epsilon(1e-12));
    }
}

TEST_CASE("the matched cones have Mohr and Coulomb's strength in triaxial tests", "[materials]") {
  const double side = -1e6, N = 3, cohesive = 2e6 * std::sqrt(3.0);
  const auto strength = [&](const char* match, double rate) {
    const auto law = cone(match, "10");
    MaterialPoint<3> point(*law);
    point.stress = side * Mat3::Identity();
    for (int k = 0; k < 40; ++k) point.step_mixed(diagonal(rate, 0, 0), 1.0, {1, 2}, side * Mat3::Identity(), 1e-5);
    return point.stress(0, 0);
  };
  CHECK(strength("1", -1e-3) == Approx(N * side - cohesive).epsilon(1e-9));
  // Extension: sa = (sr - 2 c sqrt N)/N; tension is beyond the cone, so this needs pressure
  CHECK(strength("2", 1e-3) == Approx((side + cohesive) / N).epsilon(1e-9));
}

TEST_CASE("matched in plane strain the cone flows and fails as Mohr and Coulomb's solid", "[materials]") {
  // plane strain, constant stress on the sides; at failure no stress changes and all strain is plastic
  for (const char* dilation : {"0", "10", "30"}) {
    INFO(dilation);
    const auto law = cone("4", dilation);
    MaterialPoint<3> point(*law);
    const double side = -1e6;
    point.stress = side * Mat3::Identity();
    for (int k = 0; k < 800; ++k) point.step_mixed(diagonal(0, -5e-4, 0), 1.0, {0}, side * Mat3::Identity(), 1e-5);
    CHECK(point.stress(1, 1) == Approx(3 * side - 2e6 * std::sqrt(3.0)).epsilon(1e-8));
    CHECK((point.L(0, 0) + point.L(1, 1)) / (point.L(0, 0) - point.L(1, 1)) ==
          Approx(std::sin(std::stod(dilation) * M_PI / 180)).margin(1e-8));
  }
}

TEST_CASE("beyond its cone the material returns to the apex", "[materials]") {
  const auto law = cone("1", "10");
  MaterialPoint<3> point(*law);
  point.step(diagonal(0.05, 0.05, 0.0501), 1.0);
  const double apex = 1e6 / std::tan(M_PI / 6);
  CHECK(point.stress(0, 0) == Approx(apex).epsilon(1e-12));
  CHECK(point.stress(2, 2) == Approx(apex).epsilon(1e-12));
  CHECK(point.history_value("plastic_volume") == Approx(0.1501 - apex / 2e8).epsilon(1e-9));
}

TEST_CASE("random paths of Drucker and Prager's solid stay within yield and dissipate", "[materials]") {
  for (const char* match : {"1", "4"}) {
    const auto law = cone(match, "15");
    const double s = 0.5, c = std::sqrt(0.75), sp = std::sin(15 * M_PI / 180), A_psi = 3 * sp / std::sqrt(3 + sp * sp);
    const double flat = std::sqrt(1 - A_psi * A_psi / 9) + std::sqrt(3.0) * s * A_psi / 9;
    const double A = match[0] == '1' ? 6 * s / (3 - s) : std::sqrt(3.0) * s / flat;
    const double B = 1e6 * (match[0] == '1' ? 6 * c / (3 - s) : std::sqrt(3.0) * c / flat);
    double worst = 0, least = 0;
    random_paths(*law, 5000, 6, 0.05, [&](const MaterialPoint<3>& p, double before) {
      const auto [mean, q] = pressure_shear(p.stress);
      worst = std::max(worst, (q + A * mean - B) / std::max({B, q, A * std::abs(mean)}));
      least = std::min(least, p.history_value("dissipation") - before);
    });
    CHECK(worst < 1e-9);
    CHECK(least >= 0);
  }
}

TEST_CASE("a cone must not create energy nor be without strength", "[materials]") {
  using Catch::Contains;
  CHECK_THROWS_WITH(cone("1", "31"), Contains("must not exceed <friction>"));
  CHECK_THROWS_WITH(cone("1.5", "0"), Contains("<match> is 1, 2, 3 or 4"));
  CHECK_THROWS_WITH(
      make_material("DruckerPrager", {{"rho", "1"}, {"K", "1"}, {"G", "1"}, {"cohesion", "0"}, {"friction", "0"}}),
      Contains("no strength"));
}
