// SPDX-License-Identifier: MIT
// What opens under tension closes again before it is pressed: Mohr-Coulomb, Drucker-Prager, Cam-Clay.

#include "material_point.hpp"
#include "materials/mohr_coulomb_cases.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

const Properties sand{{"rho", "1"},      {"E", "10e6"},      {"nu", "0.25"},
                      {"cohesion", "0"}, {"friction", "30"}, {"dilation", "0"}};
constexpr double bulk = 10e6 / 1.5;

double pressure(const Mat3& stress) { return -stress.trace() / 3; }

}  // namespace

TEMPLATE_TEST_CASE_SIG("sand that has opened is pressed only after it has closed", "[materials]", ((int Dim), Dim), 2,
                       3) {
  const auto type = GENERATE("MohrCoulomb", "DruckerPrager");
  const auto law = make_material(type, sand);
  MaterialPoint<Dim> point(*law);
  march(point, diagonal(0.01, 0.01, 0.01), 0.01, 100);
  CHECK(point.stress.norm() < 1e-6);
  CHECK(point.history_value("opening") == Approx(0.03).epsilon(1e-9));
  march(point, diagonal(-0.009, -0.009, -0.009), 0.01, 100);
  CHECK(point.stress.norm() < 1e-6);
  CHECK(point.history_value("opening") == Approx(0.003).epsilon(1e-8));
  march(point, diagonal(-0.002, -0.002, -0.002), 0.01, 100);
  CHECK(point.history_value("opening") == 0.0);
  CHECK(pressure(point.stress) == Approx(bulk * 0.003).epsilon(1e-7));
  CHECK(point.history_value("plastic_volume") == Approx(0.0).margin(1e-12));
  CHECK(point.history_value("dissipation") == Approx(0.0).margin(1e-9));
}

TEST_CASE("sand that is sheared while it is open closes by its volume", "[materials]") {
  const auto type = GENERATE("MohrCoulomb", "DruckerPrager");
  const auto law = make_material(type, sand);
  MaterialPoint<2> point(*law);
  march(point, diagonal(0.01, 0.0, 0.0), 0.01, 100);
  CHECK(point.history_value("opening") == Approx(0.01).epsilon(1e-6));
  // Simple shear with a compression of 0.008 along the other axis: 0.002 stays open
  Mat3 rate = diagonal(0.0, -0.008, 0.0);
  rate(0, 1) = 0.05;
  march(point, rate, 0.01, 100);
  CHECK(point.stress.norm() < 1e-6);
  CHECK(point.history_value("opening") == Approx(0.002).epsilon(1e-6));
}

TEST_CASE("noise in the strain of loose sand opens nothing for good", "[materials]") {
  const auto type = GENERATE("MohrCoulomb", "DruckerPrager");
  const auto law = make_material(type, sand);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 1e-3);
  MaterialPoint<3> point(*law);
  double strain = 0.0;
  for (int step = 0; step < 5000; ++step) {
    // A walk that returns: without memory of the opening, the pressure or the volume would grow with every step.
    Mat3 rate;
    for (int k = 0; k < 9; ++k) rate(k / 3, k % 3) = noise(random);
    rate -= 0.05 * strain / 3 * Mat3::Identity();
    strain += rate.trace();
    point.step(rate, 1.0);
    CHECK(point.history_value("opening") >= 0.0);
  }
  point.step(-strain / 3 * Mat3::Identity(), 1.0);
  // At the volume of the start there is neither pressure nor opening, up to the elastic volume under shear.
  CHECK(point.history_value("opening") < 2e-3);
  CHECK(pressure(point.stress) < 2e-3 * bulk);
}

TEST_CASE("clay beyond its least pressure closes before it is pressed", "[materials]") {
  const auto law = make_material("CamClay", {{"rho", "1"},
                                             {"lambda", "0.2"},
                                             {"kappa", "0.04"},
                                             {"e0", "1"},
                                             {"M", "1"},
                                             {"pc0", "1e5"},
                                             {"nu", "0.3"},
                                             {"pmin", "1e3"}});
  MaterialPoint<3> point(*law);
  point.stress = -1e3 * Mat3::Identity();
  march(point, diagonal(0.01, 0.01, 0.01), 0.01, 100);
  CHECK(point.history_value("opening") == Approx(0.03).epsilon(1e-6));
  march(point, diagonal(-0.01, -0.01, -0.01), 0.01, 100);
  CHECK(pressure(point.stress) == Approx(1e3).epsilon(1e-6));
  march(point, diagonal(-0.01, -0.01, -0.01), 0.01, 100);
  CHECK(point.history_value("opening") == 0.0);
  CHECK(pressure(point.stress) == Approx(1e3 * std::exp(0.03 / 0.02)).epsilon(1e-3));
}
