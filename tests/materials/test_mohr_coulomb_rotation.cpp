// SPDX-License-Identifier: MIT
// Simple shear with rotation: the Jaumann rate of the law, discrete and in the limit of small steps.

#include "materials/mohr_coulomb_cases.hpp"
#include "materials/read_table.hpp"

#include <catch2/catch.hpp>
#include <complex>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double mu = 200e6, rate = 1e-5, resistance = 866025.4037844386;
const char* const relaxation_times[] = {"0", "100", "500", "1000", "2000", "1e6"};

// (sxx - syy)/2 + i sxy after `count` steps: full rotation of the old stress, half rotation of the increment, return.
std::complex<double> reference(double eta, double dt, int count) {
  const double angle = -rate * dt, share = dt / (dt + eta);
  std::complex<double> z = 0;
  for (int n = 0; n < count; ++n) {
    z = z * std::polar(1.0, angle) + std::polar(mu * rate * dt, std::numbers::pi / 2 + angle / 2);
    const double radius = std::abs(z);
    if (radius > resistance) z *= 1 - share * (1 - resistance / radius);
  }
  return z;
}

}  // namespace

TEST_CASE("rotating viscoplastic shear equals an independent march of the same rule", "[materials]") {
  for (const char* eta : relaxation_times) {
    const auto law = published({{"relaxation_time", eta}});
    MaterialPoint<2> flat(*law);
    MaterialPoint<3> solid(*law);
    march(flat, simple_shear(rate), 1.0, 3000);
    march(solid, simple_shear(rate), 1.0, 3000);
    const std::complex<double> z = reference(std::stod(eta), 1.0, 3000);
    for (const Mat3& s : {flat.stress, solid.stress}) {
      REQUIRE(s(0, 1) == Approx(z.imag()).epsilon(1e-11));
      REQUIRE(s(0, 0) - s(1, 1) == Approx(2 * z.real()).epsilon(1e-9));
    }
  }
}

TEST_CASE("rotating viscoplastic shear converges to the Jaumann solution, normal stresses included", "[materials]") {
  const auto table = read_table("jaumann_simple_shear.csv");
  for (std::size_t k = 0; k < 6; ++k) {
    const auto law = published({{"relaxation_time", relaxation_times[k]}});
    const auto error = [&](double dt) {
      MaterialPoint<2> point(*law);
      double worst = 0, normal = 0;
      int n = 0;
      for (const auto& row : table) {
        const double t = std::stod(row[0]), shear = std::stod(row[1 + 2 * k]), difference = std::stod(row[2 + 2 * k]);
        for (; n < std::lround(t / dt); ++n) point.step(simple_shear(rate), dt);
        worst = std::max(worst, std::abs(point.stress(0, 1) - shear));
        normal = std::max(normal, std::abs(point.stress(0, 0) - point.stress(1, 1) - difference));
      }
      return std::pair{worst, normal};
    };
    const auto [coarse, coarse_normal] = error(2.0);
    const auto [fine, fine_normal] = error(1.0);
    INFO("eta " << relaxation_times[k] << ": " << coarse << " " << fine << "; " << coarse_normal << " " << fine_normal);
    // backward Euler lags an exponential by at most dt/(2 e) of its slope
    REQUIRE(fine < 1.01 * mu * rate / (2 * std::numbers::e));
    REQUIRE(coarse / fine == Approx(2).margin(0.02));
    REQUIRE(fine_normal < 2e-3 * std::stod(table.back()[2 + 2 * k]));
    REQUIRE(coarse_normal / fine_normal == Approx(2).margin(0.02));
  }
}

TEST_CASE("the elastic part of the shear is second order and the sign of the spin is right", "[materials]") {
  const auto law = published({{"cohesion", "1e12"}});
  const auto run = [&](int count) {
    MaterialPoint<2> point(*law);
    march(point, simple_shear(1.0), 1.0 / count, count);
    return point.stress;
  };
  const Mat3 coarse = run(100), fine = run(200);
  const double shear = mu * std::sin(1.0), difference = 2 * mu * (1 - std::cos(1.0));
  REQUIRE(fine(0, 1) == Approx(shear).epsilon(1e-5));
  REQUIRE(fine(0, 0) - fine(1, 1) == Approx(difference).epsilon(1e-5));
  REQUIRE((coarse(0, 1) - shear) / (fine(0, 1) - shear) == Approx(4).margin(0.05));
}
