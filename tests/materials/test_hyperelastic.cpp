// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

using Laws = std::vector<std::pair<std::string, std::unique_ptr<Material>>>;

std::unique_ptr<Material> neo_hookean(const char* option = "2") {
  return make_material("NeoHookean", {{"rho", "1"}, {"E", "1000"}, {"nu", "0.3"}, {"UJOption", option}});
}

Laws all_laws() {
  Laws laws;
  for (const char* option : {"0", "1", "2"}) {
    laws.emplace_back(std::string("NeoHookean ") + option, neo_hookean(option));
    laws.emplace_back(
        std::string("MooneyRivlin ") + option,
        make_material("8", {{"rho", "1"}, {"G1", "300"}, {"G2", "100"}, {"K", "900"}, {"UJOption", option}}));
  }
  laws.emplace_back("Hencky", make_material("Hencky", {{"rho", "1"}, {"E", "1000"}, {"nu", "0.3"}}));
  return laws;
}

Mat3 random_deformation(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  Mat3 h;
  for (int k = 0; k < 9; ++k) h(k / 3, k % 3) = size * normal(random);
  return exponential(h);
}

Mat3 rotation_z(double angle) {
  Mat3 R = Mat3::Identity();
  R(0, 0) = R(1, 1) = std::cos(angle);
  R(1, 0) = std::sin(angle), R(0, 1) = -R(1, 0);
  return R;
}

double energy_at(const Material& law, const Mat3& F) {
  MaterialPoint<3> point(law);
  point.F = F;
  point.volume = F.determinant();
  return point.stored_energy();
}

}  // namespace

TEST_CASE("the neo-Hookean solid under uniaxial stress and plane strain matches its closed form", "[materials]") {
  const auto law = neo_hookean();
  struct Row {
    double stretch, lateral, stress;
  };
  const auto solved = [&](double stretch, const std::vector<int>& free) {
    MaterialPoint<3> point(*law);
    for (int n = 0; n < 10; ++n)
      point.step_mixed(symmetric(std::log(stretch) / 10, point.L(1, 1), free.size() > 1 ? point.L(2, 2) : 0), 1.0, free,
                       Mat3::Zero(), 1e-10);
    return point;
  };
  for (const Row& row : {Row{0.5, 1.21076739, -638.048474},
                         {0.8, 1.06733837, -210.676811},
                         {1.5, 0.880174592, 488.287861},
                         {2, 0.798077544, 1015.41288}}) {
    const auto point = solved(row.stretch, {1, 2});
    REQUIRE(point.F(1, 1) == Approx(row.lateral).epsilon(1e-8));
    REQUIRE(point.F(2, 2) == Approx(row.lateral).epsilon(1e-8));
    REQUIRE(point.stress(0, 0) == Approx(row.stress).epsilon(1e-8));
    // tau = mu (b - 1) + lambda ln J
    const double J = point.F.determinant(), mu = 1000 / 2.6, lambda = 300 / (1.3 * 0.4);
    REQUIRE(J * point.stress(0, 0) ==
            Approx(mu * (row.stretch * row.stretch - 1) + lambda * std::log(J)).epsilon(1e-12));
  }
  for (const Row& row : {Row{0.8, 1.09487606, -245.353368}, {1.2, 0.921495438, 205.507006}}) {
    const auto point = solved(row.stretch, {1});
    REQUIRE(point.F(1, 1) == Approx(row.lateral).epsilon(1e-8));
    REQUIRE(point.stress(0, 0) == Approx(row.stress).epsilon(1e-8));
  }
}

TEST_CASE("neo-Hookean simple shear has sigma_xy = mu gamma and sigma_xx = mu gamma^2", "[materials]") {
  const double mu = 1000 / 2.6;
  for (const char* option : {"0", "1", "2"}) {
    const auto law = neo_hookean(option);
    for (const double gamma : {0.5, 1.0, 2.0, 4.0, -1.0}) {
      MaterialPoint<2> point(*law);
      Mat3 L = Mat3::Zero();
      L(0, 1) = gamma;
      point.step(L, 1.0);
      REQUIRE(point.stress(0, 1) == Approx(mu * gamma).epsilon(1e-13));
      REQUIRE(point.stress(0, 0) == Approx(mu * gamma * gamma).epsilon(1e-13));
      REQUIRE(std::abs(point.stress(1, 1)) + std::abs(point.stress(2, 2)) < 1e-10);
    }
  }
}

TEST_CASE("the Hencky solid matches its closed forms", "[materials]") {
  const double E = 1000, nu = 0.3, mu = E / (2 + 2 * nu), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  const auto law = make_material("Hencky", {{"rho", "1"}, {"E", "1000"}, {"nu", "0.3"}});
  const auto at = [&](const Mat3& F) {
    MaterialPoint<3> point(*law);
    point.deform(F);
    return point.stress;
  };
  for (const double l : {0.4, 0.8, 1.3, 2.0}) {
    // uniaxial stress: lateral stretch l^-nu and J sigma = E ln l, along an axis that is not one of the coordinates
    const double lateral = std::pow(l, -nu), J = std::pow(l, 1 - 2 * nu);
    const Vec3 n = Vec3(1, 2, -2) / 3;
    const Mat3 along = n * n.transpose();
    const Mat3 s = at(lateral * (Mat3::Identity() - along) + l * along);
    CHECK((s - E * std::log(l) / J * along).norm() < 1e-12 * s.norm());
    // uniform and uniaxial strain
    const Mat3 bulk = at(l * Mat3::Identity());
    CHECK((bulk - (3 * lambda + 2 * mu) * std::log(l) / (l * l * l) * Mat3::Identity()).norm() < 1e-12 * bulk.norm());
    const Mat3 confined = at(Vec3(1, l, 1).asDiagonal());
    CHECK(confined(1, 1) == Approx((lambda + 2 * mu) * std::log(l) / l).epsilon(1e-13));
    CHECK(confined(2, 2) == Approx(lambda * std::log(l) / l).epsilon(1e-13));
  }
  for (const double gamma : {0.01, 0.5, 2.0, -1.0}) {
    // simple shear: stretches exp(+-asinh(gamma/2)), tau_xy = 2 mu asinh(gamma/2)/sqrt(1 + gamma^2/4)
    Mat3 F = Mat3::Identity();
    F(0, 1) = gamma;
    const Mat3 s = at(F);
    const double shear = 2 * mu * std::asinh(gamma / 2) / std::sqrt(1 + gamma * gamma / 4);
    CHECK(s(0, 1) == Approx(shear).epsilon(1e-12));
    CHECK(s(0, 0) == Approx(0.5 * gamma * shear).epsilon(1e-11).margin(1e-12));
    CHECK(s(1, 1) == Approx(-0.5 * gamma * shear).epsilon(1e-11).margin(1e-12));
    CHECK(std::abs(s(2, 2)) < 1e-12 * mu);
  }
  // small strains: Hooke's law
  const Mat3 e = 1e-7 * symmetric(1, -2, 3, 0.5, -1, 2);
  CHECK((at(Mat3::Identity() + e) - lambda * e.trace() * Mat3::Identity() - 2 * mu * e).norm() < 1e-9);
}

TEST_CASE("the Hencky solid softens in tension and stiffens in compression as its acoustic tensor says",
          "[materials]") {
  // A wave along the axis of a bar in uniaxial strain: J times the acoustic tensor is lambda + 2 mu - J sigma
  const double E = 1000, nu = 0.3, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const auto law = make_material("Hencky", {{"rho", "1"}, {"E", "1000"}, {"nu", "0.3"}});
  MaterialPoint<3> point(*law);
  point.F = Vec3(0.7, 1, 1).asDiagonal();
  const double exact = M * (1 - std::log(0.7));
  CHECK(point.wave_modulus() > exact * (1 - 1e-14));
  CHECK(point.wave_modulus() < 1.3 * exact);
  MaterialPoint<2> inverted(*law);
  inverted.F = Vec3(-0.1, 1, 1).asDiagonal();
  REQUIRE_THROWS_AS(inverted.step(Mat3::Zero(), 1.0), SimulationError);
  REQUIRE_THROWS_WITH(make_material("Hencky", {{"rho", "1"}, {"E", "1"}, {"G", "1"}}),
                      Catch::Matchers::Contains("given: E and G"));
}

TEST_CASE("Mooney-Rivlin stress differences of isochoric motions match the incompressible forms", "[materials]") {
  // C1 = 0.3, C2 = 0.1: G1 = 2 C1, G2 = 2 C2
  const auto law = make_material("Mooney", {{"rho", "1"}, {"G1", "0.6"}, {"G2", "0.2"}, {"K", "50"}});
  const auto at = [&](const Mat3& F) {
    MaterialPoint<3> point(*law);
    point.deform(F);
    return point.stress;
  };
  const std::pair<double, double> uniaxial[] = {{0.5, -1.75}, {1.5, 1.16111111111111}, {2.0, 2.45}};
  for (const auto& [l, expected] : uniaxial) {
    const Mat3 s = at(Vec3(l, 1 / std::sqrt(l), 1 / std::sqrt(l)).asDiagonal());
    REQUIRE(s(0, 0) - s(1, 1) == Approx(expected).epsilon(1e-12));
    REQUIRE(s(1, 1) == Approx(s(2, 2)).epsilon(1e-12));
  }
  const Mat3 biaxial = at(Vec3(2, 2, 0.25).asDiagonal());
  REQUIRE(biaxial(0, 0) - biaxial(2, 2) == Approx(5.5125).epsilon(1e-12));
  Mat3 F = Mat3::Identity();
  F(0, 1) = 1;
  const Mat3 shear = at(F);
  REQUIRE(shear(0, 1) == Approx(0.8).epsilon(1e-12));
  REQUIRE(shear(0, 0) - shear(1, 1) == Approx(0.8).epsilon(1e-12));
  REQUIRE(shear(1, 1) - shear(2, 2) == Approx(-0.2).epsilon(1e-12));
}

TEST_CASE("volumetric energies give the pressure of their formulae", "[materials]") {
  const double J = 0.7, K = 900, slopes[] = {K / 2 * (J - 1 / J), K * (J - 1), K * std::log(J) / J};
  for (const char* option : {"0", "1", "2"}) {
    const auto law = make_material("Mooney", {{"rho", "1"}, {"G1", "300"}, {"K", "900"}, {"UJOption", option}});
    MaterialPoint<3> point(*law);
    point.deform(std::cbrt(J) * Mat3::Identity());
    REQUIRE(point.stress(0, 0) == Approx(slopes[option[0] - '0']).epsilon(1e-12));
  }
}

TEST_CASE("hyperelastic stress is the derivative of the stored energy", "[materials]") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const auto& [name, law] : all_laws()) {
    double worst = 0;
    for (int k = 0; k < 200; ++k) {
      const Mat3 F = random_deformation(random, 0.25);
      Mat3 h;
      for (int m = 0; m < 9; ++m) h(m / 3, m % 3) = normal(random);
      MaterialPoint<3> point(*law);
      point.deform(F);
      const double e = 1e-5, slope = (energy_at(*law, F + e * h * F) - energy_at(*law, F - e * h * F)) / (2 * e);
      const double power = F.determinant() * point.stress.cwiseProduct(h).sum();
      worst = std::max(worst, std::abs(slope - power) / (100 + std::abs(power)));
    }
    INFO(name);
    REQUIRE(worst < 1e-7);
  }
}

TEST_CASE("hyperelastic stress turns with the body", "[materials]") {
  std::mt19937 random(4);
  for (const auto& [name, law] : all_laws()) {
    MaterialPoint<2> point(*law);
    point.step(symmetric(0.3, -0.1, 0, 0.1), 1.0);
    const Mat3 start = point.stress;
    Mat3 W = Mat3::Zero();
    W(1, 0) = 2 * std::numbers::pi / 1000, W(0, 1) = -W(1, 0);
    for (int n = 1; n <= 1000; ++n) {
      point.step(W, 1.0);
      if (n % 125) continue;
      const Mat3 R = rotation_z(2 * std::numbers::pi * n / 1000);
      REQUIRE((point.stress - R * start * R.transpose()).norm() < 1e-12 * start.norm());
    }
    MaterialPoint<3> still(*law), turned(*law);
    const Mat3 F = random_deformation(random, 0.3), W3 = random_deformation(random, 0.5);
    const Mat3 Q = exponential(0.5 * (W3 - W3.transpose()));
    still.deform(F), turned.deform(Q * F);
    REQUIRE((turned.stress - Q * still.stress * Q.transpose()).norm() < 1e-12 * still.stress.norm());
  }
}

TEST_CASE("a closed hyperelastic cycle does no work and stored energy is the work done", "[materials]") {
  for (const auto& [name, law] : all_laws()) {
    const auto run = [&law = law](int count, double share) {
      MaterialPoint<3> point(*law);
      Mat3 F = Mat3::Identity();
      for (int n = 1; n <= count; ++n) {  // a loop in the space of deformations
        const double t = 2 * std::numbers::pi * share * n / count;
        F(0, 0) = 1 + 0.3 * std::sin(t), F(0, 1) = 0.4 * (1 - std::cos(t)), F(1, 2) = 0.2 * std::sin(2 * t);
        point.deform(F);
      }
      return std::pair{point.work, point.stored_energy()};
    };
    INFO(name);
    const auto [coarse, none] = run(200, 1.0);
    const auto [fine, nothing] = run(400, 1.0);
    REQUIRE(std::abs(nothing) < 1e-10);
    REQUIRE(std::abs((4 * fine - coarse) / 3) < 1e-5);  // trapezoidal rule, extrapolated
    const auto [work1, stored1] = run(100, 0.4);
    const auto [work2, stored2] = run(200, 0.4);
    REQUIRE((4 * work2 - work1) / 3 == Approx(stored2).epsilon(1e-7));
  }
}

TEST_CASE("the present wave modulus bounds every acoustic wave and is exact at rest", "[materials]") {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const auto& [name, law] : all_laws()) {
    INFO(name);
    MaterialPoint<3> rest(*law);
    REQUIRE(rest.wave_modulus() == Approx(law->wave_modulus()).epsilon(1e-13));
    double tightest = 0;
    for (int k = 0; k < 2000; ++k) {
      MaterialPoint<3> point(*law);
      point.F = random_deformation(random, 0.3);
      const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
      const Vec3 m = k % 2 ? n : Vec3(normal(random), normal(random), normal(random)).normalized();
      // J times the acoustic tensor: second difference of the energy along m (x) n
      const double e = 1e-3;
      const Mat3 h = e * m * n.transpose() * point.F;
      const double curvature =
          (energy_at(*law, point.F + h) - 2 * energy_at(*law, point.F) + energy_at(*law, point.F - h)) / (e * e);
      const double bound = point.wave_modulus();
      REQUIRE(curvature < bound * (1 + 1e-4));
      tightest = std::max(tightest, curvature / bound);
    }
    REQUIRE(tightest > 0.8);
  }
}

TEST_CASE("the wave modulus of many points is the largest one of them", "[materials]") {
  std::mt19937 random(7);
  for (const auto& [name, law] : all_laws()) {
    if (!law->history().empty()) continue;  // their modulus is not that of HyperelasticMaterial
    INFO(name);
    constexpr int count = 40;
    double F[9][count], stress[6][count] = {}, largest = 0;
    for (int i = 0; i < count; ++i) {
      MaterialPoint<3> point(*law);
      point.F = random_deformation(random, 0.3);
      for (int k = 0; k < 9; ++k) F[k][i] = point.F(k / 3, k % 3);
      largest = std::max(largest, point.wave_modulus());
    }
    MaterialPoints<3> points{};
    points.count = count;
    for (std::size_t k = 0; k < 9; ++k) points.F[k] = F[k];
    for (std::size_t k = 0; k < 6; ++k) points.stress[k] = stress[k];
    CHECK(law->wave_modulus(points) == largest);
  }
}

TEST_CASE("a neo-Hookean solid with U = lambda/2 (ln J)^2 stiffens in compression", "[materials]") {
  const auto law = neo_hookean();
  MaterialPoint<2> point(*law);
  point.F = Vec3(0.5, 1, 1).asDiagonal();
  const double mu = 1000 / 2.6, lambda = 300 / (1.3 * 0.4);
  REQUIRE(point.wave_modulus() == Approx(2 * mu + lambda * (1 + std::log(2.0))).epsilon(1e-13));
}

TEST_CASE("hyperelastic sheets in plane stress equal blocks with free faces", "[materials]") {
  for (const auto& [name, law] : all_laws()) {
    INFO(name);
    MaterialPoint<2> sheet(*law, true);
    MaterialPoint<3> block(*law);
    for (int n = 0; n < 5; ++n) {
      Mat3 L = Mat3::Zero();
      L(0, 0) = 0.1, L(0, 1) = 0.08, L(1, 0) = -0.03, L(1, 1) = -0.02;
      sheet.step(L, 1.0);
      block.step_mixed(L, 1.0, {2}, Mat3::Zero(), 1e-10);
    }
    REQUIRE(sheet.stress(2, 2) == 0.0);
    REQUIRE((sheet.stress - block.stress).norm() < 1e-11 * block.stress.norm());
    REQUIRE(sheet.F(2, 2) == Approx(block.F(2, 2)).epsilon(1e-12));
    REQUIRE(sheet.volume == Approx(sheet.F.determinant()).epsilon(1e-12));
  }
}

TEST_CASE("hyperelastic constants can be given in every pair of the dialect, and in no other way", "[materials]") {
  const auto modulus = [](const char* type, Properties p) {
    p.emplace_back("rho", "1");
    return make_material(type, p)->wave_modulus();
  };
  const double M = 1000 * 0.7 / (1.3 * 0.4);
  REQUIRE(modulus("28", {{"E", "1000"}, {"nu", "0.3"}}) == Approx(M).epsilon(1e-14));
  REQUIRE(modulus("NeoHookean", {{"G", "384.61538461538464"}, {"K", "833.33333333333337"}}) ==
          Approx(M).epsilon(1e-14));
  REQUIRE(modulus("NeoHookean", {{"G", "384.61538461538464"}, {"Lame", "576.92307692307691"}}) ==
          Approx(M).epsilon(1e-14));
  REQUIRE(modulus("Mooney", {{"E", "1000"}, {"nu", "0.3"}, {"G2", "100"}}) == Approx(M).epsilon(1e-14));
  using Catch::Matchers::Contains;
  REQUIRE_THROWS_WITH(modulus("NeoHookean", {{"E", "1"}, {"G", "1"}}), Contains("given: E and G"));
  REQUIRE_THROWS_WITH(modulus("NeoHookean", {{"K", "1"}, {"Lame", "1"}}), Contains("Lame and G"));
  REQUIRE_THROWS_WITH(modulus("NeoHookean", {}), Contains("given: none"));
  REQUIRE_THROWS_WITH(modulus("NeoHookean", {{"G", "3"}, {"Lame", "-2"}}), Contains("-2/3"));
  REQUIRE_THROWS_WITH(modulus("NeoHookean", {{"E", "1"}, {"nu", "0.3"}, {"UJOption", "1.5"}}), Contains("0, 1 or 2"));
  REQUIRE_THROWS_WITH(modulus("Mooney", {{"G1", "1"}}), Contains("G1 and K, or E and nu"));
  REQUIRE_THROWS_WITH(modulus("Mooney", {{"E", "1"}, {"nu", "0.3"}, {"G1", "1"}, {"K", "1"}}),
                      Contains("G1 and K, or E and nu"));
  REQUIRE_THROWS_WITH(modulus("Mooney", {{"E", "1"}, {"nu", "0.3"}, {"G2", "1"}}), Contains("must not exceed"));
  REQUIRE_THROWS_WITH(modulus("Mooney", {{"G1", "1"}, {"K", "1"}, {"IdealRubber", ""}}), Contains("IdealRubber"));
}

TEST_CASE("a hyperelastic point with det F <= 0 stops the run", "[materials]") {
  const auto law = neo_hookean();
  MaterialPoint<2> point(*law);
  point.F = Vec3(-0.1, 1, 1).asDiagonal();
  REQUIRE_THROWS_AS(point.step(Mat3::Zero(), 1.0), SimulationError);
}
