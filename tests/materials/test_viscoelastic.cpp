// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

const Properties prony{{"rho", "1"},  {"K", "5"},    {"G0", "0.1"}, {"Gk", "0.2"},
                       {"tauk", "1"}, {"Gk", "0.1"}, {"tauk", "10"}};

double modulus_at(double t) { return 0.1 + 0.2 * std::exp(-t) + 0.1 * std::exp(-t / 10); }

Mat3 shear(double rate) {
  Mat3 L = Mat3::Zero();
  L(0, 1) = L(1, 0) = 0.5 * rate;
  return L;
}

}  // namespace

TEST_CASE("a viscoelastic solid relaxes by its Prony series, whatever the steps", "[materials]") {
  const auto law = make_material("7", prony);
  for (const int steps : {1, 7, 100})
    for (const double t : {0.5, 3.0, 50.0}) {
      MaterialPoint<3> point(*law);
      point.step(shear(0.01 / 1e-9), 1e-9);  // at once
      for (int k = 0; k < steps; ++k) point.step(Mat3::Zero(), t / steps);
      CHECK(point.stress(0, 1) == Approx(0.01 * modulus_at(t)).epsilon(1e-8));
      CHECK(point.stress(0, 0) == Approx(0).margin(1e-15));
    }
}

TEST_CASE("sheared at a constant rate it has the exact stress after any step", "[materials]") {
  const auto law = make_material("Viscoelastic", prony);
  const double t = 4.0, exact = 0.1 * t + 0.2 * (1 - std::exp(-t)) + 0.1 * 10 * (1 - std::exp(-t / 10));
  for (const int steps : {1, 3, 50}) {
    MaterialPoint<3> point(*law);
    for (int k = 0; k < steps; ++k) point.step(shear(1e-3), t / steps);
    CHECK(point.stress(0, 1) == Approx(1e-3 * exact).epsilon(1e-12));
  }
}

TEST_CASE("volume is elastic, waves run with the short-time modulus", "[materials]") {
  const auto law = make_material("7", prony);
  MaterialPoint<3> point(*law);
  point.step(0.01 * Mat3::Identity(), 1.0);
  CHECK(point.stress(0, 0) == Approx(0.15).epsilon(1e-12));
  CHECK(law->wave_modulus() == Approx(5 + 4.0 / 3 * 0.4));
}

TEST_CASE("work is stored or dissipated", "[materials]") {
  const auto law = make_material("7", prony);
  MaterialPoint<3> point(*law);
  for (int k = 0; k < 4000; ++k) point.step(shear(1e-3 * (k < 3000 ? 1 : -1)), 1e-3);
  CHECK(point.history_value("dissipation") > 0);
  CHECK(point.stored_energy() + point.history_value("dissipation") == Approx(point.work).epsilon(1e-5));
}

TEST_CASE("its stress turns with the body, and plane stress has none out of plane", "[materials]") {
  const auto law = make_material("7", prony);
  MaterialPoint<3> still(*law), turned(*law);
  still.step(shear(0.01), 0.5), turned.step(shear(0.01), 0.5);
  Mat3 spin = Mat3::Zero();
  spin(1, 0) = 2 * M_PI / 40, spin(0, 1) = -spin(1, 0);
  for (int k = 0; k < 40; ++k) still.step(Mat3::Zero(), 0.1), turned.step(spin / 0.1, 0.1);
  CHECK((still.stress - turned.stress).norm() < 1e-12 * still.stress.norm());
  MaterialPoint<2> flat(*law, true);
  Mat3 L = Mat3::Zero();
  L(0, 0) = 0.01;
  for (int k = 0; k < 5; ++k) flat.step(L, 0.3);
  CHECK(std::abs(flat.stress(2, 2)) < 1e-12);
  CHECK(flat.F(2, 2) < 1);
}

TEST_CASE("elements of a viscoelastic solid are given as pairs", "[materials]") {
  using Catch::Contains;
  CHECK_THROWS_WITH(make_material("7", {{"rho", "1"}, {"K", "5"}, {"G0", "1"}, {"Gk", "2"}}),
                    Contains("as many <Gk> as <tauk>"));
  CHECK_THROWS_WITH(make_material("7", {{"rho", "1"}, {"K", "5"}, {"G0", "1"}, {"Gk", "2"}, {"tauk", "0"}}),
                    Contains("one positive number"));
}
