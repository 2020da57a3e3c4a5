// SPDX-License-Identifier: MIT
// Mohr-Coulomb under normal strains, prescribed stresses, random paths, softening of everything, and plane stress.

#include "materials/mohr_coulomb_cases.hpp"
#include "materials/mohr_coulomb_law.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

using namespace tribo;
using namespace tribo::test;

TEST_CASE("the oedometer follows the edge of the pyramid", "[materials]") {
  struct Row {
    const char* dilation;
    double displacement, axial, lateral;
  };
  const Row rows[] = {{"0", 0.005, 2339186.184321, 334169.454903},  {"0", 0.01, 3897804.208464, 1066198.651818},
                      {"0", 0.015, 5159331.892454, 1954425.396788}, {"0", 0.02, 6427279.592298, 2847172.399107},
                      {"10", 0.01, 4071855.389287, 1188746.032873}, {"10", 0.015, 5575309.064644, 2247310.011470},
                      {"10", 0.02, 7086413.936686, 3311261.107301}};
  for (const Row& row : rows) {
    const auto law = published({{"friction", "10"}, {"dilation", row.dilation}, {"tension", "5.67e6"}});
    const auto check = [&](auto point, int steps) {
      march(point, symmetric(std::log(1 - row.displacement), 0, 0), 1.0 / steps, steps);
      REQUIRE(point.stress(0, 0) == Approx(-row.axial).epsilon(1e-11));
      REQUIRE(point.stress(1, 1) == Approx(-row.lateral).epsilon(1e-11));
      REQUIRE(point.stress(2, 2) == Approx(-row.lateral).epsilon(1e-11));
    };
    check(MaterialPoint<3>(*law), 1);
    check(MaterialPoint<3>(*law), 500);
    check(MaterialPoint<2>(*law), 100);
  }
}

TEST_CASE("strength and dilation in triaxial compression and extension are those of the edges of the pyramid",
          "[materials]") {
  const auto law = make_material(
      "MohrCoulomb",
      {{"rho", "1"}, {"E", "10e6"}, {"nu", "0.3"}, {"cohesion", "5e3"}, {"friction", "35"}, {"dilation", "5"}});
  const double sp = std::sin(5 * degree), N = (1 + sp) / (1 - sp);
  REQUIRE(N - 1 == Approx(0.190954245).epsilon(1e-8));
  for (const double direction : {-1.0, 1.0}) {
    MaterialPoint<3> point(*law);
    point.stress = -100e3 * Mat3::Identity();
    const Mat3 target = point.stress;
    double plastic_before = 0;
    for (int n = 0; n < 50; ++n) {
      plastic_before = point.history_value("plastic_volume");
      point.step_mixed(symmetric(direction * 1e-3, -direction * 3e-4, -direction * 3e-4), 1.0, {1, 2}, target, 1e-6);
    }
    const double q = direction < 0 ? 288227.054484 : 78106.665094;
    REQUIRE(point.stress(0, 0) == Approx(-100e3 + direction * q).epsilon(1e-10));
    const double ratio = (point.history_value("plastic_volume") - plastic_before) / 1e-3;
    REQUIRE(ratio == Approx(direction < 0 ? N - 1 : 1 - 1 / N).epsilon(1e-7));
  }
}

TEST_CASE("ten thousand random paths never leave the pyramid and never create energy", "[materials]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  std::normal_distribution<double> normal;
  double worst = 0, least_work = 0;
  int plastic = 0;
  for (int path = 0; path < 10000; ++path) {
    MohrCoulombLaw law;
    law.density = 1;
    law.young_modulus = 1e7 * std::pow(10.0, u(random)), law.poisson_ratio = -0.4 + 0.88 * u(random);
    law.cohesion = path % 7 == 0 ? 0 : 1e4 * u(random);
    law.friction = path % 11 == 0 && law.cohesion > 0 ? 0 : (1 + 49 * u(random)) * degree;
    law.dilation = path % 3 == 0 ? 0 : law.friction * u(random);
    if (path % 2) law.tension = 1e4 * u(random) * u(random);
    if (path % 4 == 1) {
      law.cohesion_residual = 0.5 * law.cohesion, law.softening_start = 1e-3,
      law.softening_end = 0.01 + 0.2 * u(random);
      if (law.friction > 0) law.friction_residual = 0.7 * law.friction, law.dilation_residual = 0.2 * law.dilation;
      law.tension_residual = 0;
    }
    Problems problems;
    law.prepare(Statement{}, problems);
    problems.raise();
    MohrCoulombState state;
    Mat3 stress = -2e4 * u(random) * Mat3::Identity();
    Motion motion{Mat3::Identity(), Mat3::Zero(), 1.0};
    for (int n = 0; n < 20; ++n) {
      if (n % 5 == 0)
        for (int k = 0; k < 9; ++k) motion.L(k / 3, k % 3) = 2e-3 * normal(random) * (path % 5 == 0 ? 10 : 1);
      const double before = state.dissipation, shear_before = state.plastic_shear;
      const Mat3 D = 0.5 * (motion.L + motion.L.transpose());
      const double trial = stress.norm() + law.elastic.lambda * std::abs(D.trace()) + 2 * law.elastic.mu * D.norm();
      stress = law.stress(motion, stress, state);
      const Vec3 S = Eigen::SelfAdjointEigenSolver<Mat3>(stress).eigenvalues();
      const Strength s = law.strength(state.plastic_shear, state.tension_strain);
      const Pyramid pyramid(law.elastic, s);
      const double scale = std::max(s.cohesion, stress.norm()) + 1e-3 * law.young_modulus;
      worst = std::max(worst, std::max(pyramid.shear_excess(S(0), S(2)), S(2) - s.tension) / scale);
      // at an apex without cohesion the returned stress is the round-off of the trial stress, of either sign
      least_work = std::min(least_work, (state.dissipation - before) / (trial * trial / (2 * law.elastic.mu)));
      plastic += state.plastic_shear > shear_before;
    }
  }
  REQUIRE(plastic > 100000);
  REQUIRE(worst < 1e-9);
  INFO(least_work);
  REQUIRE(least_work > -1e-12);
}

TEST_CASE("work equals stored plus dissipated energy in the limit of small steps", "[materials]") {
  // isochoric motion: with changing volume the energy of a hypoelastic law is only defined to the order of the strain
  const auto law = published({{"dilation", "10"},
                              {"relaxation_time", "0.1"},
                              {"cohesion_residual", "0.4e6"},
                              {"softening_end", "0.02"},
                              {"tension", "0.1e6"}});
  const auto excess = [&](int count) {
    MaterialPoint<2> point(*law);
    Mat3 L = simple_shear(0.02);
    L(0, 0) = 0.005, L(1, 1) = -0.005;
    march(point, L, 1.0 / count, count);
    return (point.work - point.stored_energy() - point.history_value("dissipation")) / point.work;
  };
  const double coarse = excess(400), fine = excess(800);
  REQUIRE(std::abs(fine) < 1e-3);
  REQUIRE(coarse / fine == Approx(2).margin(0.2));
}

TEST_CASE("the cut-off softens with its own strain", "[materials]") {
  // uniaxial strain: sigma = sigma_t(kappa_t), d kappa_t = d eps - d sigma/(lambda + 2 mu)
  const auto law = published({{"tension", "0.5e6"}, {"tension_residual", "0.1e6"}, {"softening_end", "0.01"}});
  const double M = 200e6 * 7 / 3, slope = -0.4e6 / 0.01;
  for (const int steps : {1, 10}) {
    MaterialPoint<3> point(*law);
    march(point, symmetric(0.005, 0, 0), 1.0 / steps, steps);
    const double opened = (0.005 - 0.5e6 / M) / (1 + slope / M);
    REQUIRE(point.history_value("tension_strain") == Approx(opened).epsilon(1e-11));
    REQUIRE(point.stress(0, 0) == Approx(0.5e6 + slope * opened).epsilon(1e-11));
    march(point, symmetric(0.01, 0, 0), 1.0 / steps, steps);
    REQUIRE(point.stress(0, 0) == Approx(0.1e6).epsilon(1e-11));
  }
}

TEST_CASE("softening of cohesion and friction lowers the apex, and with it the cut-off", "[materials]") {
  struct Row {
    Properties changes;
    double before, after;
  };
  const auto cot = [](double phi) { return 1 / std::tan(phi * degree); };
  const Properties cohesion{{"cohesion_residual", "0.5e6"}, {"softening_end", "0.01"}},
      friction{{"friction", "20"}, {"friction_residual", "30"}, {"softening_end", "0.01"}};
  const Row rows[] = {{cohesion, 1e6 * cot(30), 0.5e6 * cot(30)},
                      {with(cohesion, {{"tension", "1.2e6"}}), 1.2e6, 0.5e6 * cot(30)},
                      {with(cohesion, {{"tension", "0.6e6"}}), 0.6e6, 0.6e6},
                      {friction, 1e6 * cot(20), 1e6 * cot(30)}};
  for (const Row& row : rows) {
    const auto law = published(row.changes);
    const auto pulled = [&](MaterialPoint<3> point) {
      march(point, symmetric(0.01, 0.01, 0.01), 0.1, 10);
      REQUIRE((point.stress - point.stress.trace() / 3 * Mat3::Identity()).norm() < 1e-6 * point.stress.norm());
      return point.stress.trace() / 3;
    };
    MaterialPoint<3> point(*law);
    REQUIRE(pulled(point) == Approx(row.before).epsilon(1e-10));
    march(point, pure_shear(0.05), 0.1, 10);  // beyond the end of softening
    REQUIRE(point.history_value("plastic_shear") > 0.01);
    REQUIRE(pulled(point) == Approx(row.after).epsilon(1e-10));
  }
}

TEST_CASE("friction and dilation soften implicitly", "[materials]") {
  // constant pressure, psi = 0: R = c cos phi - p sin phi with phi(kappa) at the end of the step
  const auto law = published({{"friction_residual", "20"}, {"softening_start", "0.002"}, {"softening_end", "0.022"}});
  for (const int steps : {1, 7}) {
    MaterialPoint<2> point(*law);
    point.stress = -5e6 * Mat3::Identity();
    march(point, pure_shear(0.05), 1.0 / steps, steps);
    const double kappa = point.history_value("plastic_shear"), phi = (30 - 10 * (kappa - 0.002) / 0.02) * degree;
    REQUIRE(kappa > 0.01);
    REQUIRE(kappa < 0.022);
    REQUIRE(point.stress(0, 1) == Approx(1e6 * std::cos(phi) + 5e6 * std::sin(phi)).epsilon(1e-11));
    REQUIRE(kappa == Approx((0.05 - point.stress(0, 1) / 200e6) / 2).epsilon(1e-11));
  }
}

TEST_CASE("in plane stress the out-of-plane stress vanishes and uniaxial strength is 2 c sqrt(N)", "[materials]") {
  const auto law = published({{"dilation", "10"}});
  MaterialPoint<2> sheet(*law, true);
  MaterialPoint<3> block(*law);
  for (int n = 0; n < 40; ++n) {
    sheet.step_mixed(symmetric(-1e-3, 5e-4, 0), 1.0, {1}, Mat3::Zero(), 1e-4);
    block.step_mixed(symmetric(-1e-3, 5e-4, 5e-4), 1.0, {1, 2}, Mat3::Zero(), 1e-4);
  }
  REQUIRE(sheet.stress(2, 2) == 0.0);
  REQUIRE(sheet.stress(0, 0) == Approx(-2e6 * std::sqrt(3.0)).epsilon(1e-9));
  REQUIRE(block.stress(0, 0) == Approx(-2e6 * std::sqrt(3.0)).epsilon(1e-9));
  REQUIRE(sheet.volume == Approx(block.volume).epsilon(1e-9));
  REQUIRE(sheet.F.determinant() == Approx(sheet.volume).epsilon(1e-12));

  MaterialPoint<2> sheared(*law, true);
  MaterialPoint<3> free(*law);
  for (int n = 0; n < 30; ++n) {
    const Mat3 L = symmetric(2e-4, -1e-4, 0, 4e-4);
    sheared.step(L, 1.0);
    free.step_mixed(L, 1.0, {2}, Mat3::Zero(), 1e-5);
  }
  REQUIRE((sheared.stress - free.stress).norm() < 1e-9 * free.stress.norm());
  REQUIRE(sheared.F(2, 2) == Approx(free.F(2, 2)).epsilon(1e-10));
  REQUIRE(sheared.L(2, 2) == Approx(free.L(2, 2)).epsilon(1e-6));
}

TEST_CASE("impossible Mohr-Coulomb parameters are refused with what is valid", "[materials]") {
  const auto complaint = [](const Properties& changes) {
    try {
      published(changes);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using Catch::Matchers::Contains;
  REQUIRE_THAT(complaint({{"dilation", "31"}}), Contains("must not exceed <friction>") && Contains("deck:7:1"));
  REQUIRE_THAT(complaint({{"friction", "90"}}), Contains("[0, 90)"));
  REQUIRE_THAT(complaint({{"friction", "-1"}}), Contains("[0, 90)"));
  REQUIRE_THAT(complaint({{"tension", "-1"}}), Contains(">= 0"));
  REQUIRE_THAT(complaint({{"E", "1e6"}}), Contains("E and nu, or K and G") && Contains("given: E and K and G"));
  REQUIRE_THAT(complaint({{"cohesion", "0"}, {"friction", "0"}}), Contains("no strength"));
  REQUIRE_THAT(complaint({{"relaxation_time", "1"}, {"viscosity", "1"}}), Contains("exclude"));
  REQUIRE_THAT(complaint({{"cohesion_residual", "1"}}), Contains("softening_end"));
  REQUIRE_THAT(complaint({{"softening_end", "1"}}), Contains("cohesion_residual"));
  REQUIRE_THAT(complaint({{"cohesion_residual", "1"}, {"softening_start", "2"}, {"softening_end", "1"}}),
               Contains("exceed <softening_start>"));
  REQUIRE_THAT(complaint({{"tension_residual", "1"}, {"softening_end", "1"}}), Contains("needs <tension>"));
  REQUIRE_THAT(complaint({{"dilation", "20"}, {"friction_residual", "10"}, {"softening_end", "1"}}),
               Contains("residual dilation"));
  REQUIRE_THAT(complaint({{"frction", "10"}}), Contains("did you mean 'friction'"));
}

TEST_CASE("the vectorised flow on the face is that of the law for one point", "[materials]") {
  std::mt19937 random(21);
  std::normal_distribution<double> normal;
  for (const auto& [relaxation_time, viscosity] : {std::pair{0.0, 0.0}, {0.4, 0.0}, {0.0, 3e8}}) {
    MohrCoulombLaw law;
    law.density = 1, law.bulk_modulus = law.shear_modulus = 200e6, law.cohesion = 1e6, law.tension = 0.5e6;
    law.friction = 30 * degree, law.dilation = 10 * degree;
    law.relaxation_time = relaxation_time, law.viscosity = viscosity;
    Problems problems;
    law.prepare(Statement{}, problems);
    problems.raise();
    const auto batch = published({{"dilation", "10"},
                                  {"tension", "0.5e6"},
                                  {"relaxation_time", std::to_string(relaxation_time)},
                                  {"viscosity", std::to_string(viscosity)}});
    const auto check = [&](auto point, bool flat) {
      MohrCoulombState state;
      for (int n = 0; n < 300; ++n) {
        Mat3 L;
        for (int k = 0; k < 9; ++k) L(k / 3, k % 3) = 4e-3 * normal(random);
        if (flat) L(0, 2) = L(1, 2) = L(2, 0) = L(2, 1) = 0;
        const Mat3 old = point.stress;
        point.step(L, 1.0);
        const Mat3 expected = law.stress({point.F, L, 1.0}, old, state);
        REQUIRE((point.stress - expected).norm() < 1e-12 * (expected.norm() + 1e6));
        const double members[] = {state.plastic_shear, state.plastic_volume, state.tension_strain, state.dissipation};
        for (std::size_t k = 0; k < 4; ++k) REQUIRE(point.history[k] == Approx(members[k]).epsilon(1e-10));
      }
      REQUIRE(state.plastic_shear > 0.1);
      REQUIRE(state.tension_strain > 0.01);
    };
    check(MaterialPoint<2>(*batch), true);
    check(MaterialPoint<3>(*batch), false);
  }
}
