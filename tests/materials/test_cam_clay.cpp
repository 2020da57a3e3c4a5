// SPDX-License-Identifier: MIT
#include "materials/pressure_shear.hpp"
#include "random_path.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

// lambda* = 0.1, kappa* = 0.02
const Properties clay{{"rho", "1"}, {"lambda", "0.2"}, {"kappa", "0.04"}, {"e0", "1"}, {"M", "0.9"}, {"pc0", "200"}};

std::unique_ptr<Material> make(const Properties& more = {{"G", "5000"}}) {
  return make_material("CamClay", with(clay, more));
}

MaterialPoint<3> consolidated(const Material& law, double p) {
  MaterialPoint<3> point(law);
  point.stress = -p * Mat3::Identity();
  return point;
}
double pressure(const MaterialPoint<3>& point) { return -point.stress.trace() / 3; }
double shear(const MaterialPoint<3>& point) { return pressure_shear(point.stress).q; }
}  // namespace

TEST_CASE("clay swells and consolidates along its lines, whatever the steps", "[materials]") {
  const auto law = make();
  for (const int steps : {1, 4, 50}) {
    INFO(steps);
    auto point = consolidated(*law, 100);
    const double swelling = 0.02 * std::log(2.0), virgin = 0.1 * std::log(1.5), all = swelling + virgin;
    for (int k = 0; k < steps; ++k) point.step(-all / 3 / steps * Mat3::Identity(), 1.0);
    CHECK(pressure(point) == Approx(300).epsilon(1e-10));
    CHECK(point.history_value("consolidation") == Approx(300).epsilon(1e-10));
    CHECK(point.history_value("plastic_volume") == Approx(-0.08 * std::log(1.5)).epsilon(1e-10));
    for (int k = 0; k < steps; ++k) point.step(0.02 * std::log(3.0) / 3 / steps * Mat3::Identity(), 1.0);
    CHECK(pressure(point) == Approx(100).epsilon(1e-10));
  }
}

TEST_CASE("sheared at constant volume clay reaches the critical state of its volume", "[materials]") {
  const auto law = make();
  // p_f = p0 (R/2)^(1 - kappa/lambda), R = pc0/p0: from the wet and the dry side
  for (const double p0 : {200.0, 150.0, 40.0}) {
    INFO(p0);
    auto point = consolidated(*law, p0);
    for (int k = 0; k < 2000; ++k) point.step(diagonal(-1e-3, 5e-4, 5e-4), 1.0);
    CHECK(pressure(point) == Approx(p0 * std::pow(200 / p0 / 2, 0.8)).epsilon(1e-3));
    CHECK(shear(point) == Approx(0.9 * pressure(point)).epsilon(1e-6));
  }
}

TEST_CASE("drained compression ends on the critical state line", "[materials]") {
  const auto law = make({{"nu", "0.3"}});
  auto point = consolidated(*law, 150);
  for (int k = 0; k < 1500; ++k) point.step_mixed(diagonal(-1e-3, 0, 0), 1.0, {1, 2}, -150 * Mat3::Identity(), 1e-8);
  const double p = 3 * 150 / (3 - 0.9);
  CHECK(pressure(point) == Approx(p).epsilon(1e-3));
  CHECK(shear(point) == Approx(0.9 * p).epsilon(1e-3));
  CHECK(std::abs(point.L.trace()) < 1e-5);  // it flows without change of volume
}

TEST_CASE("random paths of clay stay within yield and dissipate", "[materials]") {
  const auto law = make();
  double worst = 0, least = 0;
  random_paths(*law, 10000, 6, 0.03, [&](const MaterialPoint<3>& point, double before) {
    const double p = pressure(point), q = shear(point), pc = point.history_value("consolidation");
    worst = std::max(worst, (q * q + 0.81 * p * (p - pc)) / (q * q + 0.81 * p * pc));
    least = std::min(least, point.history_value("dissipation") - before);
  });
  CHECK(worst < 1e-9);
  CHECK(least >= 0);
}

TEST_CASE("invalid properties of a clay are reported", "[materials]") {
  using Catch::Contains;
  CHECK_THROWS_WITH(make({}), Contains("one of <G> and <nu>"));
  CHECK_THROWS_WITH(
      make_material(
          "CamClay",
          {{"rho", "1"}, {"lambda", "0.02"}, {"kappa", "0.04"}, {"e0", "1"}, {"M", "1"}, {"pc0", "1"}, {"nu", "0.3"}}),
      Contains("<lambda> must exceed <kappa>"));
}
