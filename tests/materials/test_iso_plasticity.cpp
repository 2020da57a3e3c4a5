// SPDX-License-Identifier: MIT
#include "materials/pressure_shear.hpp"
#include "random_path.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

const Properties steel{{"rho", "1"}, {"E", "200e3"}, {"nu", "0.3"}, {"yield", "250"}, {"Khard", "1000"}};

// Uniaxial stress to the logarithmic strain `strain`.
MaterialPoint<3> pulled(const Material& law, double strain, int steps, double dt = 1.0) {
  MaterialPoint<3> point(law);
  const double rate = strain / (steps * dt);
  for (int k = 0; k < steps; ++k)
    point.step_mixed(diagonal(rate, -0.3 * rate, -0.3 * rate), dt, {1, 2}, Mat3::Zero(), 1e-9);
  return point;
}

std::string complaint(const Properties& properties) {
  try {
    make_material("9", properties);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("von Mises plasticity with linear hardening in closed form, whatever the steps", "[materials]") {
  const auto law = make_material("VonMises", steel);
  for (const int steps : {1, 10, 100}) {
    INFO(steps);
    CHECK(pulled(*law, 0.01, steps).stress(0, 0) == Approx(258.706468).epsilon(1e-8));
    MaterialPoint<3> shear(*law);
    Mat3 D = Mat3::Zero();
    D(0, 1) = D(1, 0) = 0.01 / steps;
    for (int k = 0; k < steps; ++k) shear.step(D, 1.0);
    CHECK(shear.stress(0, 1) == Approx(150.352706).epsilon(1e-8));
    CHECK(shear.history_value("plastic_strain") == Approx(0.0104185251).epsilon(1e-8));
    MaterialPoint<3> confined(*law);
    for (int k = 0; k < steps; ++k) confined.step(diagonal(0.01 / steps, 0, 0), 1.0);
    CHECK(confined.stress(0, 0) == Approx(1837.03950).epsilon(1e-8));
    CHECK(confined.stress(1, 1) == Approx(1581.48025).epsilon(1e-8));
  }
}

TEST_CASE("von Mises plasticity: elastic below yield, same in tension and compression", "[materials]") {
  const auto law = make_material("9", steel);
  CHECK(pulled(*law, 0.00124, 3).stress(0, 0) == Approx(248).epsilon(1e-9));
  CHECK(pulled(*law, 0.00124, 3).history_value("plastic_strain") == 0.0);
  CHECK(pulled(*law, -0.01, 5).stress(0, 0) == Approx(-258.706468).epsilon(1e-8));
  // Ep is the slope in tension
  const auto tangent = make_material(
      "9", {{"rho", "1"}, {"E", "200e3"}, {"nu", "0.3"}, {"yield", "250"}, {"Ep", "20e3"}, {"Hardening", "Linear"}});
  CHECK(pulled(*tangent, 0.01, 4).stress(0, 0) == Approx(250 + 20e3 * (0.01 - 250 / 200e3)).epsilon(1e-8));
}

TEST_CASE("hardening laws of the dialect", "[materials]") {
  const Properties base{{"rho", "1"}, {"E", "200e3"}, {"nu", "0.3"}};
  const auto plastic = [](const MaterialPoint<3>& p) { return p.history_value("plastic_strain"); };
  const auto power =
      make_material("9", with(base, {{"Hardening", "Nonlinear"}, {"yield", "250"}, {"Khard", "8"}, {"nhard", "0.4"}}));
  auto point = pulled(*power, 0.03, 7);
  CHECK(point.stress(0, 0) == Approx(250 * std::pow(1 + 8 * plastic(point), 0.4)).epsilon(1e-10));
  CHECK(point.stress(0, 0) / 200e3 + plastic(point) == Approx(0.03).epsilon(1e-9));
  const auto other =
      make_material("9", with(base, {{"Hardening", "6"}, {"yield", "250"}, {"Khard", "3"}, {"nhard", "0.5"}}));
  point = pulled(*other, 0.03, 7);
  CHECK(point.stress(0, 0) == Approx(250 * (1 + 3 * std::sqrt(plastic(point)))).epsilon(1e-10));
  CHECK(point.stress(0, 0) / 200e3 + plastic(point) == Approx(0.03).epsilon(1e-9));
}

TEST_CASE("Johnson and Cook's law hardens with strain and rate", "[materials]") {
  const Properties copper{{"rho", "1"},  {"E", "124e3"}, {"nu", "0.34"},  {"Hardening", "JohnsonCook"},
                          {"Ajc", "90"}, {"Bjc", "292"}, {"njc", "0.31"}, {"Cjc", "0.025"},
                          {"ep0jc", "2"}};
  const auto law = make_material("9", copper);
  for (const double rate : {1e-30, 0.02, 50.0, 1e4}) {
    INFO(rate);
    const int steps = 400;
    const double strain = 0.1, dt = strain / rate / steps;
    auto point = pulled(*law, strain * (steps - 1) / steps, steps - 1, dt);
    const double before = point.history_value("plastic_strain");
    point.step_mixed(diagonal(rate, -0.5 * rate, -0.5 * rate), dt, {1, 2}, Mat3::Zero(), 1e-9);
    const double e = point.history_value("plastic_strain"), flow = (e - before) / dt;
    CHECK(flow == Approx(rate).epsilon(0.05));
    CHECK(point.stress(0, 0) ==
          Approx((90 + 292 * std::pow(e, 0.31)) * std::max(0.5, 1 + 0.025 * std::log(flow / 2))).epsilon(1e-9));
  }
}

TEST_CASE("the second term of the rate in Johnson and Cook's law", "[materials]") {
  const Properties copper{{"rho", "1"},  {"E", "124e3"},  {"nu", "0.34"},   {"Hardening", "JohnsonCook"},
                          {"Ajc", "90"}, {"Cjc", "0.02"}, {"Djc", "0.003"}, {"n2jc", "1.7"},
                          {"ep0jc", "2"}};
  const auto law = make_material("9", copper);
  for (const double rate : {0.5, 50.0, 1e4}) {
    INFO(rate);
    const int steps = 400;
    const double strain = 0.1, dt = strain / rate / steps;
    auto point = pulled(*law, strain * (steps - 1) / steps, steps - 1, dt);
    const double before = point.history_value("plastic_strain");
    point.step_mixed(diagonal(rate, -0.5 * rate, -0.5 * rate), dt, {1, 2}, Mat3::Zero(), 1e-9);
    const double flow = (point.history_value("plastic_strain") - before) / dt, log = std::log(flow / 2);
    const double second = log > 0 ? 0.003 * std::pow(log, 1.7) : 0.0;  // none below the reference rate
    CHECK(point.stress(0, 0) == Approx(90 * (1 + 0.02 * log + second)).epsilon(1e-9));
  }
}

TEST_CASE("a yield stress that decreases with plastic strain stops at yieldMin", "[materials]") {
  const auto law = make_material(
      "9", {{"rho", "1"}, {"E", "200e3"}, {"nu", "0.3"}, {"yield", "250"}, {"Khard", "-2000"}, {"yieldMin", "200"}});
  const auto soft = pulled(*law, 0.01, 40);
  CHECK(soft.stress(0, 0) == Approx(250 - 2000 * soft.history_value("plastic_strain")).epsilon(1e-9));
  const auto least = pulled(*law, 0.05, 200);
  CHECK(least.stress(0, 0) == Approx(200).epsilon(1e-9));
}

TEST_CASE("the strength of Johnson and Cook's law decreases with temperature up to melting", "[materials]") {
  const auto law = make_material("9", {{"rho", "1"},
                                       {"E", "124e3"},
                                       {"nu", "0.34"},
                                       {"Hardening", "JohnsonCook"},
                                       {"Ajc", "90"},
                                       {"Tmjc", "1356"},
                                       {"mjc", "1.09"}});
  CHECK(law->feels_temperature());
  const auto q_at = [&](double temperature) {
    MaterialPoint<3> point(*law);
    point.temperature = temperature, point.reference_temperature = 300;
    point.step(diagonal(0.02, -0.01, -0.01), 1.0);
    return pressure_shear(point.stress).q;
  };
  CHECK(q_at(300) == Approx(90).epsilon(1e-12));
  CHECK(q_at(20) == Approx(90).epsilon(1e-12));  // no colder than the reference
  CHECK(q_at(828) == Approx(90 * (1 - std::pow(0.5, 1.09))).epsilon(1e-12));
  CHECK(q_at(1355.999) == Approx(90 * 1.09 * 0.001 / 1056).epsilon(1e-5));
  CHECK(q_at(1356) == Approx(0).margin(1e-10));
  CHECK(q_at(2000) == Approx(0).margin(1e-10));
  CHECK_FALSE(make_material("9", steel)->feels_temperature());
}

TEST_CASE("random paths of von Mises plasticity stay within yield and dissipate", "[materials]") {
  const Properties base{{"rho", "1"}, {"E", "200e3"}, {"nu", "0.3"}, {"yield", "250"}};
  const auto law = make_material("9", with(base, {{"Hardening", "Nonlinear"}, {"Khard", "8"}, {"nhard", "0.4"}}));
  double worst = 0, least = 0;
  random_paths(*law, 10000, 6, 0.05, [&](const MaterialPoint<3>& p, double before) {
    const double allowed = 250 * std::pow(1 + 8 * p.history_value("plastic_strain"), 0.4);
    worst = std::max(worst, pressure_shear(p.stress).q / allowed - 1);
    least = std::min(least, p.history_value("dissipation") - before);
  });
  CHECK(worst < 1e-9);
  CHECK(least >= 0);
}

TEST_CASE("invalid properties of an elastic-plastic solid are reported", "[materials]") {
  const Properties base{{"rho", "1"}, {"E", "200e3"}, {"nu", "0.3"}};
  using Catch::Contains;
  CHECK_THAT(complaint(base), Contains("<yield> is missing"));
  CHECK_THAT(complaint(with(steel, {{"Hardening", "Nonliner"}})), Contains("did you mean 'Nonlinear'"));
  CHECK_THAT(complaint(with(steel, {{"Ajc", "3"}})), Contains("<Ajc> belongs to <Hardening>JohnsonCook"));
  CHECK_THAT(complaint(with(steel, {{"nhard", "3"}})), Contains("<nhard> belongs to"));
  CHECK_THAT(complaint(with(steel, {{"Ep", "3"}})), Contains("give one of <Ep> and <Khard>"));
  CHECK_THAT(complaint(with(base, {{"yield", "1"}, {"Ep", "3e5"}})), Contains("below Young's modulus"));
  CHECK_THAT(complaint(with(base, {{"Hardening", "JohnsonCook"}})), Contains("<Ajc> is missing"));
  CHECK_THAT(complaint(with(steel, {{"Tmjc", "1300"}})), Contains("<Tmjc> belongs to <Hardening>JohnsonCook"));
  CHECK_THAT(complaint(with(base, {{"Hardening", "JohnsonCook"}, {"Ajc", "3"}, {"mjc", "1"}})),
             Contains("<mjc> needs <Tmjc>"));
}
