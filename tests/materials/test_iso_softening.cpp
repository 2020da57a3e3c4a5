// SPDX-License-Identifier: MIT
#include "random_path.hpp"
#include "tests/material_point.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

// lambda = 60, mu = 40, M = 140; openings that break at 1 and slips that break at 0.5, of cells of 1.
const Properties brittle{{"rho", "1"}, {"K", "86.666666666666667"}, {"G", "40"}, {"sigmac", "2"}, {"I-Gc", "1"}};
const Properties rock{
    {"rho", "1"},     {"K", "86.666666666666667"}, {"G", "40"}, {"sigmac", "2"}, {"tauc", "1"}, {"I-Gc", "1"},
    {"II-Gc", "0.25"}};

// A thousand times as stiff with the same ratios of energies, so that strains are small and volumes stay.
Properties stiff(Properties properties, bool exponential) {
  for (auto& [name, text] : properties) {
    if (name == "K") text = "86666.666666666667";
    if (name == "G") text = "40000";
    if (name == "I-Gc") text = "1e-3";
    if (name == "II-Gc") text = "2.5e-4";
  }
  return with(properties, {{"SofteningI", exponential ? "Exponential" : "Linear"}});
}

Mat3 stretch(double e) { return symmetric(e, 0, 0); }

Mat3 kirchhoff(const MaterialPoint<3>& point) { return point.F.determinant() * point.stress; }

// The tension of a face that was pulled apart by `e` of a length of 1: what opens and what stretches.
double stress_at(double e, bool exponential) {
  const double strength = 2, length = exponential ? 0.5 : 1.0;
  double open = 0, far = e;
  for (int k = 0; k < 200; ++k) {
    const double d = 0.5 * (open + far);
    const double t = exponential ? strength * std::exp(-d / length) : strength * std::max(0.0, 1 - d / length);
    (140 * (e - d) > t ? open : far) = d;
  }
  return 140 * (e - open);
}

double largest_r(const Mat3& T, double sigmac, double tauc) {
  double most = 0;
  for (int i = 0; i <= 180; ++i)
    for (int j = 0; j < 360; ++j) {
      const double polar = M_PI * i / 180, turn = M_PI * j / 360;
      const Vec3 n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      const Vec3 t = T * n;
      const double normal = n.dot(t), open = std::max(0.0, normal);
      most =
          std::max(most, std::sqrt(open * open / (sigmac * sigmac) + (t - normal * n).squaredNorm() / (tauc * tauc)));
    }
  return most;
}

std::string refusal(const Properties& properties) {
  try {
    make_material("IsoSoftening", properties);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an opening crack follows its softening law and dissipates its fracture energy", "[materials]") {
  const bool exponential = GENERATE(false, true);
  const auto law = make_material("50", with(brittle, {{"SofteningI", exponential ? "Exponential" : "Linear"}}));
  MaterialPoint<3> point(*law);
  const int steps = 20000;
  const double end = exponential ? 8 : 1.2;
  for (int k = 1; k <= steps; ++k) {
    point.step(stretch(end / steps), 1.0);
    const double e = end * k / steps;
    if (e < 2.0 / 140 * 0.999)
      REQUIRE(kirchhoff(point)(0, 0) == Approx(140 * e).epsilon(1e-10));
    else if (k % 100 == 0)
      REQUIRE(kirchhoff(point)(0, 0) == Approx(stress_at(e, exponential)).margin(1e-9));
  }
  CHECK(point.history_value("crack_normal_x") * point.history_value("crack_normal_x") == Approx(1));
  CHECK(point.history_value("damage") > 0.9999);
  // per initial volume it would grow with the stretch; the trapezoidal rule over the steps of the softening
  CHECK(kirchhoff(point)(1, 1) == Approx(60 * end - 60 * point.history_value("crack_opening")).margin(1e-9));
}

TEST_CASE("a crack of any mode mix dissipates its fracture energy", "[materials]") {
  const bool exponential = GENERATE(false, true);
  const double pull = GENERATE(1.0, 0.3, 0.0, -0.5);
  INFO("exponential " << exponential << ", pulled by " << pull);
  const auto law = make_material("50", stiff(rock, exponential));
  MaterialPoint<3> point(*law);
  const Mat3 direction = symmetric(pull, -0.2 * pull, 0, 0.6);
  const Mat3 T = 60e3 * direction.trace() * Mat3::Identity() + 80e3 * direction;
  const int steps = 40000;
  const double end = exponential ? 2e-2 : 3e-3;
  int step = 0;
  for (; step < steps && point.history_value("damage") == 0; ++step) point.step(direction * (end / steps), 1.0);
  const Vec3 n(point.history_value("crack_normal_x"), point.history_value("crack_normal_y"),
               point.history_value("crack_normal_z"));
  const double normal = std::max(0.0, n.dot(T * n)), shear = (T * n - n.dot(T * n) * n).norm();
  // From here only the faces of the crack move, in the ratio of its tractions, so that no other crack starts.
  const Vec3 jump = normal / 140e3 * n + (T * n - n.dot(T * n) * n) / 40e3;
  const Mat3 opening = 0.5 * (n * jump.transpose() + jump * n.transpose());
  for (; step < steps; ++step) point.step(opening * (end / steps), 1.0);
  CHECK(point.history_value("damage_2") == 0);
  const double open = normal * normal / 4, slip = shear * shear, m = slip / (open + slip);
  const double k_open = 2 * 1e-3 * 140e3 / 4, k_slip = 2 * 2.5e-4 * 40e3;
  const double k = 1 / ((1 - m) / k_open + m / k_slip);
  const double band = n.lpNorm<1>();  // of cells of 1
  CHECK(band * point.history_value("dissipation") ==
        Approx((1 - m) * k / k_open * 1e-3 + m * k / k_slip * 2.5e-4).epsilon(exponential ? 1e-3 : 2e-3));
  CHECK(point.stored_energy() + point.history_value("dissipation") ==
        Approx(point.work).epsilon(5e-5));  // trapezoidal rule
}

TEST_CASE("a crack that opens within one step dissipates its fracture energy", "[materials]") {
  const bool exponential = GENERATE(false, true);
  const auto law = make_material("50", stiff(brittle, exponential));
  MaterialPoint<3> point(*law);
  point.step(stretch(0.01), 1.0);
  CHECK(point.history_value("dissipation") == Approx(1e-3).epsilon(exponential ? 1e-6 : 1e-12));
}

TEST_CASE("a second and a third crack release what the first cannot", "[materials]") {
  const auto law = make_material("50", brittle);
  MaterialPoint<3> point(*law);
  const int steps = 4000;
  const auto pull = [&](const Mat3& strain) {
    for (int k = 0; k < steps; ++k) point.step(strain / steps, 1.0);
  };
  pull(symmetric(2, 0, 0));
  CHECK(point.history_value("damage") == 1);
  CHECK(point.history_value("damage_2") == 0);
  CHECK(point.stress(1, 1) == Approx(0).margin(1e-9));  // the opening also releases the lateral stress
  // The crack is free of traction, so that the stiffness along y is that of plane stress, M - lambda^2/M.
  point.step(symmetric(0, 1e-3, 0), 1.0);
  CHECK(kirchhoff(point)(1, 1) == Approx((140 - 60.0 * 60 / 140) * 1e-3).epsilon(1e-6));
  pull(symmetric(0, 2, 0));
  CHECK(point.history_value("damage_2") == 1);
  CHECK(point.history_value("crack_normal_2_y") * point.history_value("crack_normal_2_y") == Approx(1));
  pull(symmetric(0, 0, 2));
  CHECK(point.history_value("damage_3") == 1);
  CHECK(point.stress.norm() == Approx(0).margin(1e-9));
  CHECK(point.history_value("crack_opening") == Approx(2).epsilon(1e-3));
  pull(symmetric(0, 0, 0, 0.5, 0.4, 0.3));  // rubble resists no shear as long as its cracks are open
  CHECK(point.stress.norm() == Approx(0).margin(1e-9));
  pull(symmetric(-2.1, -2.101, -2.1));  // and is as stiff as before once they are closed
  CHECK(point.stress(0, 0) < -140 * 0.05);
}

TEST_CASE("cracks in three directions lose the energy that they dissipate", "[materials]") {
  const bool exponential = GENERATE(false, true);
  const int seed = GENERATE(range(1, 9));
  const auto law = make_material("50", stiff(rock, exponential));
  MaterialPoint<3> point(*law);
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> uniform(-1, 1);
  double dissipated = 0, largest_stored = 0;
  for (int leg = 0; leg < 12; ++leg) {
    Mat3 direction;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) direction(i, j) = direction(j, i) = uniform(random);
    direction += 0.3 * Mat3::Identity();
    for (int k = 0; k < 4000; ++k) {
      point.step(direction * (1e-3 / 4000), 1.0);
      REQUIRE(point.history_value("dissipation") >= dissipated);
      dissipated = point.history_value("dissipation");
      largest_stored = std::max(largest_stored, point.stored_energy());
    }
  }
  INFO("work " << point.work << ", stored " << point.stored_energy() << ", dissipated " << dissipated);
  CHECK(point.history_value("damage_3") > 0);
  // A step of the path dissipates too much by up to the square of its change of damage.
  CHECK(std::abs(point.stored_energy() + dissipated - point.work) < 1e-4 * largest_stored + 1e-4 * dissipated);
}

TEST_CASE("a closed crack is as stiff as before and slides freely once broken", "[materials]") {
  const auto law = make_material("50", brittle);
  MaterialPoint<3> point(*law);
  for (int k = 0; k < 100; ++k) point.step(stretch(0.02), 1.0);  // broken
  CHECK(point.history_value("damage") == 1);
  CHECK(point.stress(0, 0) == Approx(0).margin(1e-12));
  for (int k = 0; k < 100; ++k) point.step(stretch(-0.02), 1.0);  // where it began
  CHECK(point.stress.norm() == Approx(0).margin(1e-9));
  point.step(stretch(-0.1) + symmetric(0, 0, 0, 0.05), 1.0);
  CHECK(kirchhoff(point)(0, 0) == Approx(-14));
  CHECK(kirchhoff(point)(1, 1) == Approx(-6));
  CHECK(point.stress(0, 1) == Approx(0).margin(1e-9));
  CHECK(point.history_value("crack_opening") == 0);
}

TEST_CASE("an unloaded crack closes and keeps its damage", "[materials]") {
  const auto law = make_material("50", brittle);
  MaterialPoint<3> point(*law);
  for (int k = 0; k < 50; ++k) point.step(stretch(0.01), 1.0);
  const double stress = kirchhoff(point)(0, 0), damage = point.history_value("damage");
  point.step(stretch(-0.25), 1.0);
  CHECK(kirchhoff(point)(0, 0) == Approx(0.5 * stress));
  CHECK(point.history_value("damage") == damage);
  point.step(stretch(0.25), 1.0);
  CHECK(kirchhoff(point)(0, 0) == Approx(stress));
}

TEST_CASE("a crack starts where and when the weakest plane fails", "[materials]") {
  const auto [sigmac, tauc] = GENERATE(std::pair(2.0, 1.0), std::pair(2.0, 1.9), std::pair(2.0, 5.0));
  auto properties = rock;
  for (auto& [name, text] : properties)
    if (name == "tauc") text = std::to_string(tauc);
  const auto law = make_material("50", with(properties, {}));
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int path = 0; path < 15; ++path) {
    Mat3 direction =
        symmetric(normal(random), normal(random), normal(random), normal(random), normal(random), normal(random));
    direction *= 1e-4 / direction.norm();
    MaterialPoint<3> point(*law);
    Mat3 T = Mat3::Zero();
    for (int k = 0; k < 100000 && point.history_value("damage") == 0; ++k) {
      T = kirchhoff(point);
      point.step(direction, 1.0);
    }
    CHECK(largest_r(T, sigmac, tauc) == Approx(1).epsilon(0.01));  // steps of half a per cent, planes every degree
  }
}

TEST_CASE("an open crack lets no stress along it gain energy", "[materials]") {
  const auto law = make_material("50", brittle);
  MaterialPoint<3> point(*law);
  for (int k = 0; k < 4000; ++k) point.step(stretch(2.0 / 4000), 1.0);  // broken, to 7.4 times its length
  for (int k = 0; k < 1000; ++k) point.step(symmetric(0, -1e-5, 0), 1.0);
  const double stored = point.stored_energy(), work = point.work, dissipated = point.history_value("dissipation");
  CHECK(stored == Approx(0.5 * (140 - 60.0 * 60 / 140) * 1e-4).epsilon(1e-6));
  for (int k = 0; k < 4000; ++k) point.step(stretch(1.0 / 4000), 1.0);
  CHECK(point.stored_energy() == Approx(stored));
  CHECK(point.work == Approx(work));
  CHECK(point.history_value("dissipation") == dissipated);
}

TEST_CASE("cracks turn with the material", "[materials]") {
  const auto law = make_material("50", brittle);
  MaterialPoint<3> point(*law);
  for (int k = 0; k < 40; ++k) point.step(stretch(0.01), 1.0);
  const Mat3 before = point.stress;
  Mat3 spin = Mat3::Zero();
  spin(0, 1) = -2 * M_PI / 1000, spin(1, 0) = 2 * M_PI / 1000;
  for (int k = 0; k < 250; ++k) point.step(spin, 1.0);
  CHECK(point.stress(1, 1) == Approx(before(0, 0)).epsilon(1e-10));
  CHECK(std::abs(point.history_value("crack_normal_y")) == Approx(1).epsilon(1e-10));
  for (int k = 0; k < 750; ++k) point.step(spin, 1.0);
  CHECK((point.stress - before).norm() < 1e-10 * before.norm());
}

TEST_CASE("random paths of a cracking solid only lose energy", "[materials]") {
  const auto law = make_material("50", with(rock, {{"SofteningI", "Exponential"}, {"SofteningII", "2"}}));
  double least = 0;
  random_paths(*law, 10000, 6, 0.05, [&](const MaterialPoint<3>& p, double before) {
    least = std::min(least, p.history_value("dissipation") - before);
    REQUIRE(p.history_value("damage") <= 1);
    REQUIRE(p.stress.allFinite());
  });
  CHECK(least >= 0);
}

TEST_CASE("invalid properties of a cracking solid are reported", "[materials]") {
  using Catch::Contains;
  const Properties base{{"rho", "1"}, {"E", "100"}, {"nu", "0.3"}, {"sigmac", "2"}, {"I-Gc", "1"}};
  CHECK(refusal(base).empty());
  CHECK_THAT(refusal(with(base, {{"II-Gc", "1"}})), Contains("<II-Gc> needs <tauc>"));
  CHECK_THAT(refusal(with(base, {{"SofteningI", "Lineer"}})), Contains("did you mean 'Linear'"));
  CHECK_THAT(refusal(with(base, {{"SofteningII", "Exponential"}})), Contains("must equal <SofteningI>"));
  CHECK_THAT(refusal(with(base, {{"Initiation", "Tresca"}})), Contains("valid: MaxPrinciple"));
  CHECK(make_material("50", base)->largest_cell() == Approx(2 * 1 * 134.6153846 / 4));
  CHECK(make_material("50", rock)->largest_cell() == Approx(2 * 0.25 * 40 / 1));
  CHECK(make_material("50", with(rock, {{"SofteningI", "2"}}))->largest_cell() == Approx(0.25 * 40 / 1));
}
