// SPDX-License-Identifier: MIT
#include "geometry/crack_tip_fields.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

constexpr double pi = std::numbers::pi;

TipField at(int mode, const Vec<2>& x, double G, double kappa) {
  return tip_field(mode, x.norm(), std::atan2(x[1], x[0]), G, kappa);
}

}  // namespace

TEST_CASE("the fields of a crack tip are in equilibrium and leave the faces free", "[fracture]") {
  const double G = 3, kappa = 1.8, e = 1e-5;
  for (const int mode : {1, 2}) {
    for (const auto& x : {Vec<2>(1, 0.3), Vec<2>(-0.7, 1.1), Vec<2>(-0.4, -0.9)}) {
      const Vec<2> dx(e, 0), dy(0, e);
      const Mat<2> by_x = (at(mode, x + dx, G, kappa).stress - at(mode, x - dx, G, kappa).stress) / (2 * e);
      const Mat<2> by_y = (at(mode, x + dy, G, kappa).stress - at(mode, x - dy, G, kappa).stress) / (2 * e);
      CHECK((by_x.col(0) + by_y.col(1)).norm() < 1e-9);
      // u_i,12 = u_i,21: there are displacements
      const Vec<2> one = (at(mode, x + dy, G, kappa).gradient - at(mode, x - dy, G, kappa).gradient).col(0);
      const Vec<2> other = (at(mode, x + dx, G, kappa).gradient - at(mode, x - dx, G, kappa).gradient).col(1);
      CHECK((one - other).norm() / (2 * e) < 1e-9);
    }
    for (const double angle : {pi, -pi}) CHECK(tip_field(mode, 2.0, angle, G, kappa).stress.col(1).norm() < 1e-15);
  }
}

TEST_CASE("faces open under K1 and slide under K2", "[fracture]") {
  // behind the tip the faces are apart by K (kappa + 1)/G sqrt(r/(2 pi)); its slope towards the tip
  const double G = 3, kappa = 1.8, r = 0.5, slope = -(kappa + 1) / G / (2 * std::sqrt(2 * pi * r));
  for (const int mode : {1, 2}) {
    const Vec<2> apart =
        (tip_field(mode, r, pi, G, kappa).gradient - tip_field(mode, r, -pi, G, kappa).gradient).col(0);
    CHECK(apart[mode == 1 ? 1 : 0] == Approx(slope));
    CHECK(std::abs(apart[mode == 1 ? 0 : 1]) < 1e-15);
  }
  // ahead of it, K/sqrt(2 pi r)
  CHECK(tip_field(1, r, 0, G, kappa).stress(1, 1) == Approx(1 / std::sqrt(2 * pi * r)));
  CHECK(tip_field(2, r, 0, G, kappa).stress(0, 1) == Approx(1 / std::sqrt(2 * pi * r)));
}

TEST_CASE("the J integral of a pure mode around any circle is K^2/E'", "[fracture]") {
  const double G = 3, kappa = 1.8, per_J = 8 * G / (kappa + 1);
  for (const int mode : {1, 2})
    for (const double r : {0.5, 2.0}) {
      double J = 0;
      const int steps = 2000;
      for (int k = 0; k < steps; ++k) {
        const double angle = -pi + (k + 0.5) * 2 * pi / steps;
        const TipField f = tip_field(mode, r, angle, G, kappa);
        const Vec<2> n(std::cos(angle), std::sin(angle));
        const double energy = 0.5 * f.stress.cwiseProduct(f.gradient).sum();
        J += (energy * n[0] - (f.stress * n).dot(f.gradient.col(0))) * r * 2 * pi / steps;
      }
      CHECK(J == Approx(1 / per_J).epsilon(1e-4));
    }
}
