// SPDX-License-Identifier: MIT
// Simple shear without rotation: closed forms of Mohr-Coulomb viscoplasticity.
// shear_modulus = 200 MPa, shear rate 1e-5/s; see materials/README.md for the formulae.

#include "materials/mohr_coulomb_cases.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double shear_modulus = 200e6, bulk = 200e6, lame = bulk - 2 * shear_modulus / 3, rate = 1e-5;

// sigma_xy after n backward-Euler steps of dt: overstress decays by 1/(1 + dt/eta) per step.
double backward_euler(double resistance, double eta, double dt, int n) {
  const int elastic_steps = static_cast<int>(std::floor(resistance / (shear_modulus * rate * dt)));
  if (n <= elastic_steps) return shear_modulus * rate * dt * n;
  const double plateau = resistance + shear_modulus * rate * eta, start = elastic_steps * shear_modulus * rate * dt;
  return start - (plateau - start) * std::expm1((elastic_steps - n) * std::log1p(dt / eta));
}

template <int Dim>
void check_history(const char* friction, double resistance, double eta) {
  const auto law = published({{"friction", friction}, {"relaxation_time", text(eta)}});
  MaterialPoint<Dim> point(*law);
  double worst = 0;
  for (int n = 1; n <= 3000; ++n) {
    point.step(pure_shear(rate), 1.0);
    const double expected = backward_euler(resistance, eta, 1.0, n);
    worst = std::max(worst, std::abs(point.stress(0, 1) / expected - 1));
  }
  INFO("eta " << eta);
  REQUIRE(worst < 1e-12);
  REQUIRE(point.history_value("plastic_shear") ==
          Approx((3000 * rate - point.stress(0, 1) / shear_modulus) / 2).epsilon(1e-11));
  REQUIRE(std::abs(point.history_value("plastic_volume")) < 1e-15);
  REQUIRE(std::abs(point.stress(2, 2)) + std::abs(point.stress(0, 0)) < 1e-6);
}

}  // namespace

TEST_CASE("viscoplastic shear follows the backward-Euler closed form for every relaxation time", "[materials]") {
  for (const double eta : {0.1, 100.0, 500.0, 1000.0, 2000.0, 1e6}) {
    check_history<2>("30", 866025.4037844386, eta);
    check_history<3>("30", 866025.4037844386, eta);
    check_history<2>("0", 1e6, eta);
  }
}

TEST_CASE("published stresses of viscoplastic shear are met at 3000 s", "[materials]") {
  const std::vector<std::pair<const char*, double>> values{{"0.1", 866225.403784},   {"100", 1066025.403783},
                                                           {"500", 1860102.020139},  {"1000", 2712295.405413},
                                                           {"2000", 3757399.326851}, {"1e6", 5993413.650500}};
  for (const auto& [eta, expected] : values) {
    const auto law = published({{"relaxation_time", eta}});
    MaterialPoint<2> point(*law);
    march(point, pure_shear(rate), 1.0, 3000);
    REQUIRE(point.stress(0, 1) == Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("each step of viscoplastic shear relaxes with its own length", "[materials]") {
  const double resistance = 866025.4037844386, eta = 500;
  const auto law = published({{"relaxation_time", "500"}});
  MaterialPoint<2> point(*law);
  double shear = 0;
  for (int n = 0; n < 400; ++n) {
    const double dt = 1 + 7 * (n % 5) + (n % 3 == 0 ? 300 : 0), b = dt / eta;
    point.step(pure_shear(rate), dt);
    shear += shear_modulus * rate * dt;
    if (shear > resistance) shear = (shear + b * resistance) / (1 + b);
    REQUIRE(point.stress(0, 1) == Approx(shear).epsilon(1e-12));
  }
  REQUIRE(shear > 1.5 * resistance);
}

TEST_CASE("Perzyna flow on one plane equals Duvaut-Lions with eta_p = a eta", "[materials]") {
  const auto perzyna = published({{"viscosity", text(500 * shear_modulus)}}),
             relaxing = published({{"relaxation_time", "500"}});
  MaterialPoint<2> first(*perzyna), second(*relaxing);
  march(first, pure_shear(rate), 1.0, 1000);
  march(second, pure_shear(rate), 1.0, 1000);
  REQUIRE(first.stress(0, 1) == Approx(1543908.938780).epsilon(1e-12));
  REQUIRE((first.stress - second.stress).norm() < 1e-12 * first.stress.norm());
  REQUIRE(first.history_value("plastic_shear") == Approx(second.history_value("plastic_shear")).epsilon(1e-12));
}

TEST_CASE("pressure strengthens and tension weakens in shear", "[materials]") {
  for (const auto& [mean, resistance] :
       {std::pair{-1e6, 1366025.403784439}, {-5e6, 3366025.403784439}, {1e6, 366025.403784439}}) {
    const auto law = published();
    MaterialPoint<2> point(*law);
    point.stress = mean * Mat3::Identity();
    march(point, pure_shear(rate), 1.0, 3000);
    REQUIRE(point.stress(0, 1) == Approx(resistance).epsilon(1e-13));
    REQUIRE(point.stress(0, 0) == Approx(mean).epsilon(1e-12));
    REQUIRE(point.stress(2, 2) == Approx(mean).epsilon(1e-14));
  }
}

TEST_CASE("cohesion softens along the closed form, slowly and at once", "[materials]") {
  const Properties softening{{"cohesion_residual", "0.5e6"}, {"softening_end", "0.01"}};
  const auto law = published(softening);
  MaterialPoint<2> point(*law);
  const std::vector<std::pair<int, double>> values{{1000, 728367.104848}, {2000, 485578.069899}, {3000, 433012.701892}};
  int n = 0;
  for (const auto& [until, expected] : values) {
    march(point, pure_shear(rate), 1.0, until - n);
    n = until;
    REQUIRE(point.stress(0, 1) == Approx(expected).epsilon(1e-11));
  }
  // one step over yield, softening and its end
  MaterialPoint<3> leap(*law);
  leap.step(pure_shear(rate), 3000.0);
  REQUIRE(leap.stress(0, 1) == Approx(433012.701892).epsilon(1e-11));
}

TEST_CASE("viscous softening follows its own backward-Euler march and converges to the closed form", "[materials]") {
  const double h = -0.5 * 0.5e6 / 0.01 * std::cos(30 * degree), eta = 500, resistance = 866025.4037844386;
  const auto law = published({{"cohesion_residual", "0.5e6"}, {"softening_end", "0.01"}, {"relaxation_time", "500"}});
  const auto run = [&](double dt) {
    MaterialPoint<2> point(*law);
    double shear = 0, slip = 0;  // scalar march: d slip = dt/(shear_modulus eta) overstress at the end of the step
    const int count = static_cast<int>(std::lround(2000 / dt));
    for (int n = 0; n < count; ++n) {
      point.step(pure_shear(rate), dt);
      shear += shear_modulus * rate * dt;
      const double over = shear - resistance - h * slip;
      if (over <= 0) continue;
      const double more = over * dt / (shear_modulus * eta) / (1 + (shear_modulus + h) * dt / (shear_modulus * eta));
      slip += more, shear -= shear_modulus * more;
      REQUIRE(std::abs(point.stress(0, 1) / shear - 1) < 1e-11);
    }
    return point.stress(0, 1);
  };
  const double exact = 1666228.065681, coarse = run(4.0) - exact, fine = run(2.0) - exact;
  REQUIRE(std::abs(fine) < 5e-3 * exact);
  REQUIRE(coarse / fine == Approx(2).margin(0.05));
}

TEST_CASE("dilation under confinement raises pressure on the face and along the edge", "[materials]") {
  struct Row {
    const char* dilation;
    double mean, gamma, shear, pressure, out_of_plane;
  };
  const Row rows[] = {{"10", 0, 0.005, 879925.842835, -27800.878102, -6950.219526},
                      {"10", 0, 0.01, 983680.132407, -235309.457246, -58827.364311},
                      {"10", 0, 0.03, 1398697.290694, -1065343.773820, -266335.943455},
                      {"10", 0, 0.08, 2436240.186412, -3140429.565255, -785107.391314},
                      {"10", 0, 0.10, 2833259.617533, -3934468.427497, -1101208.809964},
                      {"10", 0, 0.15, 3797047.357352, -5862043.907134, -2064996.549783},
                      {"30", 0, 0.01, 1149519.052838, -566987.298108, -141746.824527},
                      {"30", 0, 0.05, 3134615.192258, -4537179.576946, -1402564.384689},
                      {"10", -1e6, 0.03, 1846820.145908, -1961589.484248, -1240397.371062}};
  for (const Row& row : rows) {
    const auto law = published({{"dilation", row.dilation}});
    const auto check = [&](auto point) {
      point.stress = row.mean * Mat3::Identity();
      march(point, pure_shear(rate), row.gamma / rate / 97, 97);
      INFO("psi " << row.dilation << " gamma " << row.gamma);
      REQUIRE(point.stress(0, 1) == Approx(row.shear).epsilon(1e-11));
      REQUIRE(point.stress(0, 0) == Approx(row.pressure).epsilon(1e-9));
      REQUIRE(point.stress(1, 1) == Approx(row.pressure).epsilon(1e-9));
      REQUIRE(point.stress(2, 2) == Approx(row.out_of_plane).epsilon(1e-9));
      REQUIRE(point.history_value("plastic_volume") * bulk ==
              Approx(-(point.stress.trace() / 3 - row.mean)).epsilon(1e-9));
    };
    check(MaterialPoint<2>(*law));
    check(MaterialPoint<3>(*law));
  }
}

TEST_CASE("viscous dilation has the overstress of pure shear and its own pressure", "[materials]") {
  const double sf = 0.5, sp = std::sin(10 * degree), a = shear_modulus + (lame + shear_modulus) * sf * sp, eta = 500,
               dt = 1;
  const auto law = published({{"dilation", "10"}, {"relaxation_time", "500"}});
  MaterialPoint<2> point(*law);
  double shear = 0, p = 0, zz = 0;
  for (int n = 1; n <= 3000; ++n) {
    point.step(pure_shear(rate), dt);
    shear += shear_modulus * rate * dt;
    const double over = shear + p * sf - 866025.4037844386;
    if (over > 0) {
      const double slip = over / a * dt / (dt + eta);
      shear -= shear_modulus * slip, p -= (lame + shear_modulus) * sp * slip, zz -= lame * sp * slip;
    }
    REQUIRE(std::abs(point.stress(0, 1) / shear - 1) < 1e-12);
    REQUIRE(std::abs(point.stress(0, 0) - p) < 1e-12 * shear);
    REQUIRE(std::abs(point.stress(2, 2) - zz) < 1e-12 * shear);
    if (n == 1000) REQUIRE(point.stress(0, 1) == Approx(1591557.102506).epsilon(1e-3));
  }
  // continuous in time
  REQUIRE(point.stress(0, 1) == Approx(2289661.343408).epsilon(2e-4));
  REQUIRE(point.stress(0, 0) == Approx(-859058.061659).epsilon(2e-3));
  REQUIRE(point.stress(2, 2) == Approx(-214764.515415).epsilon(2e-3));
}

TEST_CASE("the axes of a K0 stress turn with plastic shear", "[materials]") {
  // tan(th/2) = tan(th0/2) exp(-shear_modulus (gamma - gamma_y)/R), s = R sin th, t = R cos th
  const double mean = -1.5e6, s0 = 0.5e6, R = 866025.4037844386 - 0.5 * mean;
  const auto law = published();
  const auto run = [&](double gamma, int count) {
    MaterialPoint<2> point(*law);
    point.stress = symmetric(mean + s0, mean - s0, mean);
    march(point, pure_shear(1.0), gamma / count, count);
    return std::pair{0.5 * (point.stress(0, 0) - point.stress(1, 1)), point.stress(0, 1)};
  };
  const double yield = std::sqrt(R * R - s0 * s0) / shear_modulus;
  const double rows[3][3] = {{0.008, 481692.441558, 1542566.205199},
                             {0.01, 379440.941160, 1570847.757693},
                             {0.03, 32377.592823, 1615701.023445}};
  for (const auto& [gamma, s, t] : rows) {
    const double th0 = std::asin(s0 / R),
                 th = 2 * std::atan(std::tan(th0 / 2) * std::exp(-shear_modulus * (gamma - yield) / R));
    REQUIRE(R * std::sin(th) == Approx(s).epsilon(1e-11));
    const auto [coarse_s, coarse_t] = run(gamma, 2000);
    const auto [fine_s, fine_t] = run(gamma, 4000);
    REQUIRE(fine_s == Approx(s).epsilon(2e-3));
    REQUIRE(fine_t == Approx(t).epsilon(2e-3));
    if (std::abs(gamma - 0.03) < 1e-9) REQUIRE((coarse_s - s) / (fine_s - s) == Approx(2).margin(0.05));
  }
}
