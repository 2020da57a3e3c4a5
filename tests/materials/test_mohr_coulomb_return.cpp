// SPDX-License-Identifier: MIT
#include "materials/mohr_coulomb_law.hpp"
#include "materials/mohr_coulomb_return.hpp"

#include "material_point.hpp"
#include "materials/read_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

struct Case {
  Elasticity elastic;
  double cohesion, friction, dilation, tension;  // degrees; tension < 0: none
};

const std::map<std::string, Case>& cases() {
  const Elasticity stiff = Elasticity::bulk_shear(200e6, 200e6);
  static const std::map<std::string, Case> all{
      {"A", {stiff, 1e6, 30, 30, -1}},  {"B", {stiff, 1e6, 30, 30, 0.5e6}},
      {"C", {stiff, 1e6, 30, 10, -1}},  {"D", {stiff, 1e6, 30, 0, 0.2e6}},
      {"F", {stiff, 1e6, 0, 0, 0.3e6}}, {"E", {Elasticity::young(10e6, 0.3), 5e3, 35, 5, 0}}};
  return all;
}

Pyramid pyramid(const Case& c) {
  const double s = std::sin(c.friction * degree), k = std::cos(c.friction * degree);
  const double apex = c.friction > 0 ? c.cohesion * k / s : std::numeric_limits<double>::infinity();
  return {c.elastic,
          {c.cohesion, s, k, std::sin(c.dilation * degree), c.tension < 0 ? apex : std::min(c.tension, apex)}};
}

std::unique_ptr<Material> law_of(const Case& c, Properties more = {}) {
  const auto text = [](double x) {
    std::ostringstream out;
    out.precision(17);
    out << x;
    return out.str();
  };
  Properties p{{"rho", "1000"},
               {"K", text(c.elastic.bulk())},
               {"G", text(c.elastic.mu)},
               {"cohesion", text(c.cohesion)},
               {"friction", text(c.friction)},
               {"dilation", text(c.dilation)}};
  if (c.tension >= 0) p.emplace_back("tension", text(c.tension));
  p.insert(p.end(), more.begin(), more.end());
  return make_material("MohrCoulomb", p);
}

// The stress after a step of unit time without strain.
Mat3 relaxed(const Material& law, const Mat3& trial) {
  MaterialPoint<3> point(law);
  point.stress = trial;
  point.step(Mat3::Zero(), 1.0);
  return point.stress;
}

void check_relaxed(const std::string& id, const Properties& viscous, const Triple& expected) {
  for (const auto& row : read_table("mohr_coulomb_points.csv")) {
    if (row[0] != id) continue;
    const Mat3 s = relaxed(*law_of(cases().at(row[1]), viscous),
                           Vec3(std::stod(row[2]), std::stod(row[3]), std::stod(row[4])).asDiagonal());
    INFO(id);
    for (int k = 0; k < 3; ++k)
      REQUIRE(s(k, k) == Approx(expected[static_cast<std::size_t>(k)]).epsilon(1e-12).margin(1e-6));
  }
}

}  // namespace

TEST_CASE("returns to faces, edges, corners and the cut-off agree with exact arithmetic", "[materials]") {
  int points = 0;
  for (const auto& row : read_table("mohr_coulomb_points.csv")) {
    if (row.size() != 8) continue;
    INFO(row[0]);
    const Case& c = cases().at(row[1]);
    Triple trial, expected;
    for (std::size_t k = 0; k < 3; ++k) trial[k] = std::stod(row[2 + k]), expected[k] = std::stod(row[5 + k]);
    const Returned r = pyramid(c).nearest(trial);
    for (std::size_t k = 0; k < 3; ++k)
      REQUIRE(std::abs(r.stress[k] - expected[k]) <= 1e-12 * (std::abs(trial[0]) + c.cohesion));
    ++points;
  }
  REQUIRE(points == 50);
}

TEST_CASE("tensors return along their own principal axes, also with equal principal values", "[materials]") {
  int tensors = 0;
  for (const auto& row : read_table("mohr_coulomb_points.csv")) {
    if (row.size() != 14) continue;
    INFO(row[0]);
    std::array<double, 12> v;
    for (std::size_t k = 0; k < 12; ++k) v[k] = std::stod(row[2 + k]);
    const Mat3 s = relaxed(*law_of(cases().at(row[1])), symmetric(v[0], v[1], v[2], v[3], v[4], v[5]));
    const Mat3 expected = symmetric(v[6], v[7], v[8], v[9], v[10], v[11]);
    REQUIRE((s - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.norm());
    ++tensors;
  }
  REQUIRE(tensors == 5);
}

TEST_CASE("Duvaut-Lions keeps 1/(1 + dt/eta) of the way back", "[materials]") {
  const Properties half{{"relaxation_time", "2"}};
  check_relaxed("A1", half, {-4905502.116982, -2047248.941509, 527510.584910});
  check_relaxed("A3", half, {-4841949.607753, 482028.087987, 548694.754653});
  check_relaxed("B4", half, {-2947168.783649, -1026415.608176, 735843.918244});
  check_relaxed("D1", half, {-4997008.467928, -2000000, -502991.532072});
  check_relaxed("E4", half, {-12857.142857142857, 1142.857142857143, 13333.333333333333});
}

TEST_CASE("Perzyna flow acts on the planes that are active without viscosity", "[materials]") {
  const auto viscosity = [](const char* id) {  // eta_p = 2 a dt
    const Case& c = cases().at(id);
    const double sf = std::sin(c.friction * degree), sp = std::sin(c.dilation * degree);
    std::ostringstream out;
    out.precision(17);
    out << 2 * (c.elastic.mu + (c.elastic.lambda + c.elastic.mu) * sf * sp);
    return Properties{{"viscosity", out.str()}};
  };
  check_relaxed("A1", viscosity("A"), {-4905502.116982, -2047248.941509, 527510.584910});
  check_relaxed("A3", viscosity("A"), {-4826301.054065, 437163.063514, 507492.733843});
  check_relaxed("A4", viscosity("A"), {-5940035.200981, -5748990.424861, 390256.258422});
  check_relaxed("C2", viscosity("C"), {-4529641.172120, 519536.335808, 591248.995437});
}

TEST_CASE("Mohr-Coulomb strength in triaxial compression and extension, at the apex and in pure shear", "[materials]") {
  const Case c{Elasticity::young(1e4, 0.25), 10, 30, 30, -1};
  const Pyramid p = pyramid(c);
  const double N = 3, cohesive = 2 * 10 * std::sqrt(N);
  REQUIRE(p.shear_excess(-(N * 100 + cohesive), -100) == Approx(0).margin(1e-12));
  REQUIRE(N * 100 + cohesive == Approx(334.641016).epsilon(1e-8));
  REQUIRE(p.shear_excess(-100, -(100 - cohesive) / N) == Approx(0).margin(1e-12));
  REQUIRE((100 - cohesive) / N == Approx(21.7863280).epsilon(1e-8));
  REQUIRE(p.strength().tension == Approx(17.3205081).epsilon(1e-8));
  REQUIRE(p.shear_excess(-8.660254037844386, 8.660254037844386) == Approx(0).margin(1e-12));
}

TEST_CASE("batches return points where the search among all planes does", "[materials]") {
  const Properties soils[] = {{{"cohesion", "3"}, {"friction", "30"}, {"dilation", "10"}},
                              {{"cohesion", "3"}, {"friction", "30"}, {"dilation", "30"}, {"tension", "1"}},
                              {{"cohesion", "0"}, {"friction", "35"}, {"dilation", "0"}},
                              {{"cohesion", "3"}, {"friction", "0"}, {"tension", "4"}},
                              {{"cohesion", "3"}, {"friction", "0"}},
                              {{"cohesion", "3"}, {"friction", "30"}, {"dilation", "10"}, {"relaxation_time", "0.5"}},
                              {{"cohesion", "3"}, {"friction", "30"}, {"dilation", "10"}, {"viscosity", "50"}}};
  const auto index = GENERATE(range(0, 7));
  auto properties = soils[index];
  properties.insert(properties.end(), {{"rho", "1"}, {"K", "800"}, {"G", "300"}});
  INFO("soil " << index);
  const auto law = make_material("MohrCoulomb", properties);
  MohrCoulombLaw reference;
  {
    Problems problems;
    const auto statement = material_statement(properties);
    for (const auto& p : MohrCoulombLaw::parameters())
      if (const Statement* s = statement.child(std::string(p.name)))
        reference.*p.member = std::stod(s->text) * (p.dimension == Dimension::angle ? M_PI / 180 : 1);
    reference.prepare(statement, problems);
    problems.raise();
  }
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 3000; ++k) {
    const double size = 0.02 * std::pow(10.0, -2 * std::uniform_real_distribution<double>()(random));
    Mat3 strain = size * Vec3(normal(random), normal(random), normal(random)).asDiagonal();
    MaterialPoint<3> point(*law);
    point.step(strain, 1.0);
    const Mat3 trial = 600 * strain.trace() * Mat3::Identity() + 600 * strain;
    Triple sorted{trial(0, 0), trial(1, 1), trial(2, 2)};
    std::array<int, 3> place{0, 1, 2};
    std::sort(place.begin(), place.end(), [&](int a, int b) { return trial(a, a) < trial(b, b); });
    std::sort(sorted.begin(), sorted.end());
    Triple change{};
    MohrCoulombState state;
    if (reference.pyramid().yields(sorted[0], sorted[2]))
      change = reference.flow(sorted, 1.0, point.F.determinant(), state);
    const double margin = 1e-10 * (3 + trial.norm());
    for (std::size_t d = 0; d < 3; ++d)
      REQUIRE(point.stress(place[d], place[d]) == Approx(sorted[d] - change[d]).margin(margin));
    REQUIRE(point.history_value("plastic_shear") == Approx(state.plastic_shear).epsilon(1e-9).margin(1e-14));
    REQUIRE(point.history_value("plastic_volume") == Approx(state.plastic_volume).epsilon(1e-9).margin(1e-14));
    REQUIRE(point.history_value("tension_strain") == Approx(state.tension_strain).epsilon(1e-9).margin(1e-14));
    REQUIRE(point.history_value("dissipation") == Approx(state.dissipation).epsilon(1e-9).margin(1e-12));
  }
}
