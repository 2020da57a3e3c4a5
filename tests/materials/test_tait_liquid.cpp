// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

// Stress of one point with deformation gradient F under the velocity gradient L.
Mat3 stress_of(const Material& law, const Mat3& F, const Mat3& L) {
  std::array<double, 9> f{}, l{};
  std::array<double, 6> s{};
  double mass = 1, volume = 1, dissipation = 0;
  MaterialPoints<3> points;
  points.count = 1, points.dt = 1e-3;
  for (std::size_t k = 0; k < 9; ++k) points.F[k] = &f[k], points.L[k] = &l[k];
  for (std::size_t k = 0; k < 6; ++k) points.stress[k] = &s[k];
  store_full<3>(F, points.F, 0);
  store_full<3>(L, points.L, 0);
  double* history[] = {&dissipation};
  points.mass = &mass, points.volume = &volume, points.history = history;
  law.update(points);
  return load_symmetric<3>(points.stress, 0);
}

}  // namespace

TEST_CASE("a Tait liquid has the pressures of its equation", "[materials]") {
  const auto water = make_material("27", {{"rho", "1000"}, {"K", "2.2e9"}, {"viscosity", "1e-3"}});
  const std::pair<double, double> table[] = {{0.99, 23277614.4}, {0.95, 147395861}, {1.005, -10698049}};
  for (const auto& [J, p] : table) {
    Mat3 F = Mat3::Identity();
    F(1, 1) = J;
    const Mat3 s = stress_of(*water, F, Mat3::Zero());
    CHECK(-s(0, 0) == Approx(p).epsilon(1e-8));
    CHECK(s(0, 0) == Approx(s(1, 1)));
    CHECK(s(0, 1) == 0.0);
  }
}

TEST_CASE("the shear stress of a liquid follows its viscosity curve", "[materials]") {
  const auto water = make_material("27", {{"rho", "1000"}, {"K", "2.2e9"}, {"viscosity", "1e-3"}});
  Mat3 L = Mat3::Zero();
  L(0, 1) = 7.0;
  CHECK(stress_of(*water, Mat3::Identity(), L)(0, 1) == Approx(7e-3));
  CHECK(water->liquid());
  const auto paint = make_material("27", {{"rho", "1000"},
                                          {"K", "1e6"},
                                          {"viscosity", "4"},
                                          {"logshearrate", "0"},
                                          {"viscosity", "1"},
                                          {"logshearrate", "2"}});
  CHECK(paint->viscosity(0.01) == 4.0);
  CHECK(paint->viscosity(10.0) == Approx(2.5));
  CHECK(paint->viscosity(1e5) == 1.0);
  CHECK(paint->largest_viscosity() == 4.0);
  L(0, 1) = 10.0;
  CHECK(stress_of(*paint, Mat3::Identity(), L)(0, 1) == Approx(25.0));
  CHECK_THROWS(make_material(
      "27", {{"rho", "1000"}, {"K", "1e6"}, {"viscosity", "4"}, {"viscosity", "1"}, {"logshearrate", "2"}}));
}
