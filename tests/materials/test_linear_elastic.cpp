// SPDX-License-Identifier: MIT
#include "material_point.hpp"
#include "materials/elastic.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

std::unique_ptr<Material> unit_steel() { return make_material("1", {{"rho", "1"}, {"E", "1000"}, {"nu", "0.3"}}); }
constexpr double mu = 1000 / 2.6;

// Hooke's law written for one point, as a user would, with the simplest objective update.
struct PointwiseHooke {
  static constexpr std::string_view name = "PointwiseHooke", summary = "";
  static constexpr int number = 0;
  static std::array<Parameter<PointwiseHooke>, 0> parameters() { return {}; }
  void prepare(const Statement&, Problems&) {}
  double density = 1;
  Elasticity elastic = Elasticity::young(1000, 0.3);
  double wave_modulus() const { return elastic.wave_modulus(); }
  struct State {
    double steps = 0;
  };
  static auto history() { return std::make_tuple(StateVariable<State>{"steps", Dimension::none, &State::steps}); }
  Mat3 stress(const Motion& motion, const Mat3& old, State& state) const {
    ++state.steps;
    const Mat3 half = spin_rotation(motion.L, 0.5 * motion.dt), D = 0.5 * motion.dt * (motion.L + motion.L.transpose());
    const Mat3 more = elastic.lambda * D.trace() * Mat3::Identity() + 2 * elastic.mu * D;
    return half * (half * old * half.transpose() + more) * half.transpose();
  }
  double energy_density(const Mat3&, const Mat3& stress, const State&) const { return elastic.energy(stress); }
};

}  // namespace

TEST_CASE("linear elasticity has Hooke's uniaxial strain, uniaxial stress and free lateral strain", "[materials]") {
  const auto law = unit_steel();
  MaterialPoint<3> strain(*law), stress(*law);
  strain.step(symmetric(0.01, 0, 0), 1.0);
  REQUIRE(strain.stress(0, 0) == Approx(13.461538461538463).epsilon(1e-13));
  REQUIRE(strain.stress(1, 1) == Approx(5.769230769230769).epsilon(1e-13));
  stress.step_mixed(symmetric(0.01, 0, 0), 1.0, {1, 2}, Mat3::Zero(), 1e-12);
  REQUIRE(stress.L(1, 1) == Approx(-0.003).epsilon(1e-12));
  REQUIRE(stress.stress(0, 0) == Approx(10).epsilon(1e-12));
  MaterialPoint<2> plane(*law);
  plane.step_mixed(symmetric(0.01, 0, 0), 1.0, {1}, Mat3::Zero(), 1e-12);
  REQUIRE(plane.L(1, 1) == Approx(-0.00428571428571429).epsilon(1e-12));
  REQUIRE(plane.stress(0, 0) == Approx(10.989010989010989).epsilon(1e-12));
  REQUIRE(plane.stress(2, 2) == Approx(3.2967032967032965).epsilon(1e-12));
}

TEST_CASE("linear elasticity in large shear is the Jaumann rate, to second order", "[materials]") {
  const auto law = unit_steel();
  const auto run = [&](auto point, double gamma, int count) {
    Mat3 L = Mat3::Zero();
    L(0, 1) = gamma / count;
    for (int n = 0; n < count; ++n) point.step(L, 1.0);
    return std::pair{point.stress(0, 1) / mu, point.stress(0, 0) / mu};
  };
  for (const double gamma : {0.5, 1.0, 2.0, 4.0, -1.0}) {
    const auto [shear, normal] = run(MaterialPoint<2>(*law), gamma, 1000);
    const auto [shear3, normal3] = run(MaterialPoint<3>(*law), gamma, 1000);
    REQUIRE(shear == Approx(std::sin(gamma)).margin(2e-6));
    REQUIRE(normal == Approx(1 - std::cos(gamma)).margin(2e-6));
    REQUIRE(shear3 == Approx(shear).epsilon(1e-12));
    REQUIRE(normal3 == Approx(normal).epsilon(1e-12));
  }
  REQUIRE(run(MaterialPoint<2>(*law), 2, 1000).first == Approx(0.909297).margin(2e-6));
  REQUIRE(run(MaterialPoint<2>(*law), 4, 1000).first == Approx(-0.756802).margin(2e-6));
  const double coarse = run(MaterialPoint<2>(*law), 2, 100).first - std::sin(2.0);
  const double fine = run(MaterialPoint<2>(*law), 2, 200).first - std::sin(2.0);
  REQUIRE(coarse / fine == Approx(4).margin(0.05));
}

TEST_CASE("linear elastic stress turns with the body through a full circle", "[materials]") {
  const auto law = unit_steel();
  for (const int count : {3, 1000}) {  // large and small angles per step
    MaterialPoint<2> flat(*law);
    MaterialPoint<3> solid(*law);
    flat.step(symmetric(0.1, -0.02, 0, 0.03), 1.0);
    solid.step(symmetric(0.1, -0.02, 0.01, 0.03, -0.02, 0.05), 1.0);
    const Mat3 start2 = flat.stress, start3 = solid.stress;
    Mat3 W2 = Mat3::Zero(), W3;
    const double a = 2 * std::numbers::pi / count;
    W2(1, 0) = a, W2(0, 1) = -a;
    W3 << 0, -2, 2, 2, 0, -1, -2, 1, 0;
    W3 *= a / 3;
    Mat3 R2 = Mat3::Identity(), R3 = R2;
    for (int n = 0; n < count; ++n) {
      flat.step(W2, 1.0), solid.step(W3, 1.0);
      R2 = exponential(W2) * R2, R3 = exponential(W3) * R3;
      if (n % 100 == 0) {
        REQUIRE((flat.stress - R2 * start2 * R2.transpose()).norm() < 1e-12 * start2.norm());
        REQUIRE((solid.stress - R3 * start3 * R3.transpose()).norm() < 1e-12 * start3.norm());
      }
    }
    REQUIRE((flat.stress - start2).norm() < 1e-12 * start2.norm());
    REQUIRE((solid.stress - start3).norm() < 1e-12 * start3.norm());
  }
}

TEST_CASE("linear elastic plane stress has E/(1 - nu^2) and thins the sheet", "[materials]") {
  const auto law = unit_steel();
  MaterialPoint<2> sheet(*law, true);
  sheet.step(symmetric(0.01, 0, 0), 1.0);
  REQUIRE(sheet.stress(0, 0) == Approx(1000 / 0.91 * 0.01).epsilon(1e-13));
  REQUIRE(sheet.stress(1, 1) == Approx(300 / 0.91 * 0.01).epsilon(1e-13));
  REQUIRE(std::abs(sheet.stress(2, 2)) < 1e-13);
  REQUIRE(sheet.L(2, 2) == Approx(-0.3 / 0.7 * 0.01).epsilon(1e-13));
  REQUIRE(sheet.F(2, 2) == Approx(std::exp(-0.003 / 0.7)).epsilon(1e-13));
  REQUIRE(sheet.volume == Approx(sheet.F.determinant()).epsilon(1e-13));
  REQUIRE(sheet.stored_energy() == Approx(sheet.volume * 0.5 * 1000 / 0.91 * 1e-4).epsilon(1e-12));
}

TEST_CASE("a law written for one point gives what the batch gives, in plane stress too", "[materials]") {
  const auto law = unit_steel();
  const PointwiseMaterial<PointwiseHooke> pointwise{PointwiseHooke{}};
  for (const bool plane_stress : {false, true}) {
    MaterialPoint<2> a(*law, plane_stress), b(pointwise, plane_stress);
    Mat3 L = Mat3::Zero();
    L(0, 0) = 0.02, L(0, 1) = 0.3, L(1, 0) = -0.2, L(1, 1) = 0.01;
    for (int n = 0; n < 10; ++n) a.step(L, 1.0), b.step(L, 1.0);
    REQUIRE((a.stress - b.stress).norm() < 1e-12 * a.stress.norm());
    REQUIRE((a.F - b.F).norm() < 1e-12);
    REQUIRE(a.volume == Approx(b.volume).epsilon(1e-12));
    REQUIRE(a.stored_energy() == Approx(b.stored_energy()).epsilon(1e-12));
    REQUIRE(b.history_value("steps") == 10.0);
  }
}

TEST_CASE("properties read elsewhere are skipped by the law, others are refused", "[materials]") {
  const Properties p{{"rho", "1"}, {"E", "1"}, {"nu", "0.3"}, {"alpha", "12"}};
  REQUIRE(make_material("Isotropic", p, {"alpha"})->density() == 1.0);
  REQUIRE_THROWS_WITH(make_material("Isotropic", p), Catch::Matchers::Contains("<alpha> is not a property"));
}

TEST_CASE("rigid materials have motion only", "[materials]") {
  for (const char* type : {"11", "35", "Rigid", "RigidContact"}) {
    const auto law = make_material(type, {{"SetDirection", "3"}}, {"SetDirection"});
    REQUIRE(law->rigid());
    REQUIRE(law->density() == 1.0);
    REQUIRE(law->history().empty());
    MaterialPoint<3> point(*law);
    point.step(symmetric(0.1, 0, 0), 1.0);
    REQUIRE(point.stress == Mat3::Zero());
    REQUIRE_THROWS_AS(make_material(type, {{"E", "1"}}), InputError);
  }
  REQUIRE_FALSE(unit_steel()->rigid());
}
