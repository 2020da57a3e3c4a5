// SPDX-License-Identifier: MIT
/// Traction laws of cohesive zones against closed forms: loading, unloading, reloading, peak, failure, compression,
/// mixed modes, energy to failure. All zones have an area of 0.5.

#include "archived.hpp"
#include "contact/joint_cases.hpp"
#include "contact/traction_curve.hpp"

#include <cmath>
#include <functional>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double zone_area = 0.5;

test::Contact zone(const char* type, const Properties& properties, double gap = 0.0) {
  JointSite site;
  site.area = zone_area, site.gap = gap;
  return {type, properties, site};
}

/// A law with its curves in closed form: sigma = 3 and 2, delta_c = 0.4 and 0.6 in opening and sliding.
struct TractionCase {
  const char* type;
  Properties properties;
  std::function<double(double)> T[2];
  double J[2], peak_at[2], end[2];
};

double triangle(double d, double at, double peak, double end) {
  return d < at ? peak * d / at : d < end ? peak * (end - d) / (end - at) : 0.0;
}

std::vector<TractionCase> traction_cases() {
  const Properties peaks{{"sigmaI", "3"}, {"sigmaII", "2"}}, ends{{"delIc", "0.4"}, {"delIIc", "0.6"}};
  const Properties places{{"delpkI", "0.25"}, {"delpkII", "0.5"}};
  const double a = 2.5, f = 2 * (1 / a - std::exp(-a) / (1 - std::exp(-a)));
  const auto cubic = [](double d, double peak, double end) {
    const double x = std::min(d / end, 1.0);
    return 27.0 / 4 * peak * x * (1 - x) * (1 - x);
  };
  const auto decay = [a](double d, double at, double peak, double end) {
    if (d < at) return peak * d / at;
    if (d > end) return 0.0;
    return peak * (std::exp(-a * (d - at) / (end - at)) - std::exp(-a)) / (1 - std::exp(-a));
  };
  const auto three = [](double d, double d1, double T1, double d2, double T2, double end) {
    return d < d1 ? T1 * d / d1 : d < d2 ? T1 + (T2 - T1) * (d - d1) / (d2 - d1) : triangle(d, d2, T2, end);
  };
  return {
      {"TriangularTraction",
       peaks + ends + places,
       {[](double d) { return triangle(d, 0.1, 3, 0.4); }, [](double d) { return triangle(d, 0.3, 2, 0.6); }},
       {0.6, 0.6},
       {0.1, 0.3},
       {0.4, 0.6}},
      {"CubicTraction",
       peaks + ends,
       {[=](double d) { return cubic(d, 3, 0.4); }, [=](double d) { return cubic(d, 2, 0.6); }},
       {9.0 / 16 * 3 * 0.4, 9.0 / 16 * 2 * 0.6},
       {0.4 / 3, 0.2},
       {0.4, 0.6}},
      {"TrilinearTraction",
       peaks + ends +
           Properties{{"delpkI", "0.1"},
                      {"delpkII", "0.2"},
                      {"sigmaI2", "1"},
                      {"sigmaII2", "1.5"},
                      {"delpkI2", "0.3"},
                      {"delpkII2", "0.5"}},
       {[=](double d) { return three(d, 0.04, 3, 0.12, 1, 0.4); },
        [=](double d) { return three(d, 0.12, 2, 0.3, 1.5, 0.6); }},
       {0.5 * (3 * 0.12 + 1 * (0.4 - 0.04)), 0.5 * (2 * 0.3 + 1.5 * (0.6 - 0.12))},
       {0.04, 0.12},
       {0.4, 0.6}},
      {"ExponentialTraction",
       peaks + ends + places + Properties{{"alphaI", "2.5"}, {"alphaII", "2.5"}},
       {[=](double d) { return decay(d, 0.1, 3, 0.4); }, [=](double d) { return decay(d, 0.3, 2, 0.6); }},
       {0.5 * 3 * 0.4 * (0.25 + 0.75 * f), 0.5 * 2 * 0.6 * (0.5 + 0.5 * f)},
       {0.1, 0.3},
       {0.4, 0.6}},
      {"CoupledTraction",
       {{"sigmaI", "3"}, {"delIc", "0.4"}, {"delpkI", "0.25"}},
       {[](double d) { return triangle(d, 0.1, 3, 0.4); }, [](double d) { return triangle(d, 0.1, 3, 0.4); }},
       {0.6, 0.6},
       {0.1, 0.1},
       {0.4, 0.4}},
      {"MixedModeTraction",
       peaks + ends + Properties{{"modelII", "14"}, {"delpkI", "0.25"}},
       {[](double d) { return triangle(d, 0.1, 3, 0.4); }, [=](double d) { return cubic(d, 2, 0.6); }},
       {0.6, 9.0 / 16 * 2 * 0.6},
       {0.1, 0.2},
       {0.4, 0.6}},
  };
}

/// Moves the zone in one mode: opening, or sliding along (0.6, 0.8).
void step(test::Contact& j, int mode, double by) {
  if (mode == 0)
    j.move(by);
  else
    j.shear(0.6 * by, 0.8 * by);
}
double traction(const test::Contact& j, int mode) { return (mode == 0 ? j.joint.Fn : j.joint.Fs.norm()) / zone_area; }
double energy(const test::Contact& j) { return j.joint.decohesion[0] + j.joint.decohesion[1]; }

}  // namespace

TEST_CASE("traction laws follow their curves, unload to the origin and reload", "[traction]") {
  for (const auto& c : traction_cases())
    for (const int mode : {0, 1}) {
      INFO(c.type << ", mode " << mode + 1);
      auto j = zone(c.type, c.properties);
      double largest = 0, end = c.end[mode];
      constexpr int steps = 200;
      for (int k = 1; k < steps; ++k) {
        step(j, mode, end / steps);
        const double T = traction(j, mode);
        CHECK(T == near(c.T[mode](end * k / steps), 1e-10));
        largest = std::max(largest, T);
        if (k % 20 != 0) continue;
        // half way back: half of the traction; then the curve again
        for (int back = 0; back < k / 2; ++back) step(j, mode, -end / steps);
        CHECK(traction(j, mode) == near(T / 2, 1e-9));
        const double lost = energy(j);
        for (int back = 0; back < k / 2; ++back) step(j, mode, end / steps);
        CHECK(traction(j, mode) == near(T, 1e-9));
        CHECK(energy(j) == near(lost, 1e-12));
      }
      CHECK(largest == near(mode == 0 ? 3 : c.type == std::string("CoupledTraction") ? 3 : 2, 2e-3));
      CHECK(j.state() == "softening");
      CHECK(j.count(JointEvent::Kind::bond_break) == 0);
      step(j, mode, 1.01 * end / steps);
      CHECK(traction(j, mode) == 0);
      CHECK(j.state() == "broken");
      REQUIRE(j.count(JointEvent::Kind::bond_break) == 1);
      CHECK(j.events.back().mode == mode + 1);
      CHECK(j.events.back().energy == near(zone_area * c.J[mode], 1e-10));
    }
}

TEST_CASE("the energy to failure of a traction law is the area under its curve, for any steps", "[traction]") {
  for (const auto& c : traction_cases())
    for (const int mode : {0, 1}) {
      INFO(c.type << ", mode " << mode + 1);
      for (const int steps : {1, 7, 100}) {
        auto j = zone(c.type, c.properties);
        for (int k = 0; k < steps; ++k) step(j, mode, 1.5 * c.end[mode] / steps);
        CHECK(energy(j) == near(c.J[mode], 1e-10));
        CHECK(j.own(mode == 0 ? "GI" : "GII") == near(c.J[mode], 1e-10));
        CHECK(j.joint.strain == 0);
      }
      // the work of the faces agrees with it, to the second order of the steps
      double error[2];
      for (const int n : {0, 1}) {
        auto j = zone(c.type, c.properties);
        const int steps = n == 0 ? 300 : 1200;
        for (int k = 0; k < steps; ++k) step(j, mode, 1.2 * c.end[mode] / steps);
        error[n] = std::abs(j.joint.released() - zone_area * c.J[mode]);
      }
      CHECK(error[0] < 2e-4 * c.J[mode]);
      CHECK(error[1] < 2e-5 * c.J[mode]);
    }
}

TEST_CASE("the traction resists the displacement: signs of opening, closing and sliding", "[traction]") {
  for (const auto& c : traction_cases()) {
    INFO(c.type);
    auto j = zone(c.type, c.properties);
    j.move(0.01, {0.01, -0.02});
    CHECK(j.joint.Fn > 0);
    CHECK(j.joint.Fs.s < 0);
    CHECK(j.joint.Fs.t > 0);
    CHECK(j.joint.Fs.t == near(-2 * j.joint.Fs.s));
    j.move(-0.03);
    CHECK(j.joint.Fn < 0);
    // closed faces: the initial slope, whatever the damage
    const double k = zone(c.type, c.properties).move(-1e-3).joint.Fn / -1e-3;
    CHECK(j.joint.Fn == near(-0.02 * k));
    auto broken = zone(c.type, c.properties);
    broken.move(1.0).move(-1.01);
    CHECK(broken.state() == "broken");
    CHECK(broken.joint.Fn == near(-0.01 * k));
    CHECK_FALSE(broken.joint.away);
    broken.move(0.02);
    CHECK(broken.joint.Fn == 0);
    CHECK(broken.joint.away);
    auto softer = zone(c.type, c.properties + Properties{{"kClosed", "7"}});
    CHECK(softer.move(-0.1).joint.Fn == near(-0.1 * 7 * zone_area));
  }
}

TEST_CASE("a traction law creates no energy on any path", "[traction]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> of(-0.03, 0.032);
  for (const auto& c : traction_cases())
    for (int path = 0; path < 20; ++path) {
      INFO(c.type);
      auto j = zone(c.type, c.properties);
      double last = 0;
      for (int k = 0; k < 300; ++k) {
        // small steps, so that the trapezoidal rule of the work is accurate
        const double n = of(random), s = of(random), t = of(random);
        for (int part = 0; part < 20; ++part) j.move(n / 20, {s / 20, t / 20});
        CHECK(energy(j) >= last - 1e-15);
        last = energy(j);
        CHECK(j.joint.strain >= 0);
        // the state can be saved and restored at any time
        ArchivedState state = archived(j.joint);
        Joint restored;
        MemoryArchive reader(state, true);
        reader("object", restored);
        REQUIRE(archived(restored) == state);
        REQUIRE(j.joint.released() == Approx(zone_area * last).margin(2e-3));
      }
    }
}

TEST_CASE("mixed modes of separate curves: (GI/JIc)^n + (GII/JIIc)^n = 1", "[traction]") {
  const auto c = traction_cases()[0];
  for (const double n : {1.0, 2.0}) {
    auto j = zone("TriangularTraction", c.properties + Properties{{"nmix", n == 1 ? "1" : "2"}});
    // sliding up to GII, then opening until failure: triangle with peak 2 at 0.3, end 0.6
    j.shear(0.0, 0.4);
    const double GII = 0.5 * 2 * 0.3 + 0.5 * (2 + 4.0 / 3) * 0.1;
    const double GI = 0.6 * std::pow(1 - std::pow(GII / 0.6, n), 1 / n);
    CHECK(j.joint.Fs.t == near(-zone_area * 4.0 / 3));
    double opening = 0;
    while (j.state() != "broken") j.move(1e-4), opening += 1e-4;
    // area of the triangle with peak 3 at 0.1, end 0.4
    const double at = GI < 0.15 ? std::sqrt(2 * GI / 30) : 0.4 - std::sqrt((0.6 - GI) * 2 * 0.3 / 3);
    CHECK(opening == Approx(at).margin(1.01e-4));
    CHECK(energy(j) == near(GI + GII, 1e-10));
    CHECK(j.joint.Fn == 0);
    CHECK(j.joint.Fs.norm() == 0);
  }
  // without an exponent the modes do not know of each other until one of them has failed
  auto j = zone("TriangularTraction", c.properties + Properties{{"nmix", "0"}});
  j.shear(0.0, 0.59).move(0.39);
  CHECK(j.joint.Fs.t == near(-zone_area * 2 * 0.01 / 0.3));
  CHECK(j.joint.Fn == near(zone_area * 3 * 0.01 / 0.3));
  j.move(0.02);
  CHECK(j.state() == "broken");
}

TEST_CASE("mixed modes of one curve: the effective displacement counts", "[traction]") {
  for (const double angle : {0.2, 0.9, 1.4})
    for (const int steps : {1, 50}) {
      auto j = zone("CoupledTraction", traction_cases()[4].properties);
      const double d = 0.3;
      for (int k = 0; k < steps; ++k) j.move(d * std::cos(angle) / steps, {0, d * std::sin(angle) / steps});
      const double T = triangle(d, 0.1, 3, 0.4);
      CHECK(j.joint.Fn == near(zone_area * T * std::cos(angle), 1e-10));
      CHECK(j.joint.Fs.t == near(-zone_area * T * std::sin(angle), 1e-10));
      for (int k = 0; k < steps; ++k) j.move(d * std::cos(angle) / steps, {0, d * std::sin(angle) / steps});
      CHECK(energy(j) == near(0.6, 1e-10));
      CHECK(j.joint.decohesion[0] == near(0.6 * std::pow(std::cos(angle), 2), 1e-9));
    }
}

TEST_CASE("mixed modes with one damage reach the ellipse of the strengths and fail together", "[traction]") {
  const auto c = traction_cases()[5];
  auto j = zone(c.type, c.properties);
  for (int k = 0; k < 100 && j.state() != "broken"; ++k) {
    j.move(0.003, {0.004, 0.002});
    if (j.joint.damage[0] == 0 || j.state() == "broken") continue;
    // at the damage D the triangle has d_n* = 0.04/(0.4 - 0.3 D), the cubic d_t* = 0.6 (1 - sqrt(1 - D))
    const double D = j.joint.damage[0];
    const double n = j.joint.opening / (0.04 / (0.4 - 0.3 * D)),
                 t = j.joint.shear.norm() / (0.6 * (1 - std::sqrt(1 - D)));
    CHECK(n * n + t * t == near(1, 1e-9));
    CHECK(j.joint.damage[1] == D);
    CHECK(j.joint.Fn == near(zone_area * (1 - D) * 30 * j.joint.opening, 1e-10));
  }
  CHECK(j.state() == "broken");
  CHECK(j.joint.decohesion[0] / c.J[0] + j.joint.decohesion[1] / c.J[1] == Approx(1).epsilon(0.05));
}

TEST_CASE("linear tractions never fail, prescribed ones do not depend on the displacement", "[traction]") {
  auto spring = zone("LinearTraction", {{"kIe", "20"}, {"kIIe", "10"}});
  spring.move(3.0, {1, 2});
  CHECK(spring.joint.Fn == near(zone_area * 60));
  CHECK(spring.joint.Fs.t == near(-zone_area * 20));
  CHECK(spring.joint.strain == near(zone_area * 0.5 * (20 * 9 + 10 * 5)));
  CHECK(energy(spring) == 0);
  CHECK(spring.state() == "intact");
  auto only_normal = zone("LinearTraction", {{"kIe", "20"}});
  CHECK(only_normal.move(1.0, {1, 2}).joint.Fs.norm() == 0);

  auto pressed = zone("PressureTraction", {{"stress", "-4"}, {"kClosed", "100"}});
  CHECK(pressed.move(0.3).joint.Fn == near(-zone_area * 4));
  CHECK(pressed.move(-0.4).joint.Fn == near(-zone_area * (4 + 100 * 0.1)));
  CHECK(pressed.joint.Fs.norm() == 0);
}

TEST_CASE("the traction of a function of time", "[traction]") {
  Problems problems;
  const auto law = joint_laws().find("26")->make(joint_statement({{"function", "-2*t"}}), {}, Units{}, problems);
  problems.raise();
  JointSite site;
  site.area = zone_area;
  Joint joint = law->start(site);
  JointIncrement d;
  d.time = 1.5;
  std::vector<JointEvent> events;
  law->update({&joint, 1}, {&d, 1}, events);
  CHECK(joint.Fn == near(-zone_area * 3));
}

TEST_CASE("faces that are apart at the start are not bonded", "[traction]") {
  auto j = zone("CubicTraction", traction_cases()[1].properties, 0.2);
  CHECK(j.state() == "broken");
  CHECK(j.move(-0.1).joint.Fn == 0);
  CHECK(j.move(-0.11).joint.Fn < 0);
}

TEST_CASE("the properties of a traction law follow from those given", "[traction]") {
  const auto same = [](const char* type, const Properties& given, const Properties& expected, double tolerance = 1e-9) {
    auto a = zone(type, given), b = zone(type, expected);
    for (int k = 0; k < 30; ++k) {
      a.move(0.01, {0, 0.015}), b.move(0.01, {0, 0.015});
      CHECK(a.joint.Fn == near(b.joint.Fn, tolerance));
      CHECK(a.joint.Fs.t == near(b.joint.Fs.t, tolerance));
    }
  };
  const Properties sliding{{"sigmaII", "2"}, {"delIIc", "0.6"}, {"delpkII", "0.5"}, {"nmix", "0"}};
  const Properties opening{{"sigmaI", "3"}, {"delIc", "0.4"}, {"delpkI", "0.25"}};
  // J = 0.6, k = 30
  for (const auto& given : std::vector<Properties>{{{"sigmaI", "3"}, {"JIc", "0.6"}, {"kIe", "30"}},
                                                   {{"JIc", "0.6"}, {"delIc", "0.4"}, {"kIe", "30"}},
                                                   {{"sigmaI", "3"}, {"delIc", "0.4"}, {"kIe", "30"}},
                                                   {{"sigmaI", "3"}, {"JIc", "0.6"}, {"delpkI", "0.25"}},
                                                   {{"JIc", "0.6"}, {"kIe", "30"}, {"delpkI", "0.25"}},
                                                   {{"sigmaI", "3"}, {"kIe", "30"}, {"delpkI", "0.25"}},
                                                   {{"delIc", "0.4"}, {"kIe", "30"}, {"delpkI", "0.25"}}})
    same("TriangularTraction", given + sliding, opening + sliding);
  same("TriangularTraction", Properties{{"sigmaI", "3"}, {"delIc", "0.4"}} + sliding,
       Properties{{"sigmaI", "3"}, {"delIc", "0.4"}, {"delpkI", "0.225926299"}} + sliding);
  // the area of the exponential curve
  const double a = 2.5, f = 2 * (1 / a - std::exp(-a) / (1 - std::exp(-a)));
  const std::string J = std::to_string(0.5 * 3 * 0.4 * (0.25 + 0.75 * f));
  const Properties decays{{"alphaI", "2.5"}, {"alphaII", "2.5"}};
  for (const auto& given : std::vector<Properties>{{{"sigmaI", "3"}, {"JIc", J}, {"kIe", "30"}},
                                                   {{"JIc", J}, {"delIc", "0.4"}, {"kIe", "30"}},
                                                   {{"JIc", J}, {"kIe", "30"}, {"delpkI", "0.25"}},
                                                   {{"sigmaI", "3"}, {"JIc", J}, {"delpkI", "0.25"}},
                                                   {{"sigmaI", "3"}, {"JIc", J}, {"delIc", "0.4"}}})
    same("ExponentialTraction", given + sliding + decays, opening + sliding + decays, 2e-5);
  same("CubicTraction", {{"sigmaI", "3"}, {"JIc", "0.675"}, {"JIIc", "0.675"}, {"delIIc", "0.6"}},
       {{"sigmaI", "3"}, {"delIc", "0.4"}, {"sigmaII", "2"}, {"delIIc", "0.6"}});
  // trilinear, opening: corners (0.04, 3), (0.12, 1), end 0.4, J = 0.36, k = 75
  const Properties all{{"sigmaI", "3"},  {"delpkI", "0.1"}, {"sigmaI2", "1"}, {"delpkI2", "0.3"},
                       {"delIc", "0.4"}, {"JIc", "0.36"},   {"kIe", "75"}};
  const Properties second = Properties{{"sigmaII", "2"},    {"delpkII", "0.2"}, {"sigmaII2", "1.5"},
                                       {"delpkII2", "0.5"}, {"delIIc", "0.6"},  {"nmix", "0"}};
  const auto without = [&](std::initializer_list<const char*> names) {
    Properties out = second;
    for (const auto& p : all)
      if (std::none_of(names.begin(), names.end(), [&](const char* n) { return p.first == n; })) out.push_back(p);
    return out;
  };
  const Properties reference = without({"JIc", "kIe"});
  for (const char* left_out : {"sigmaI", "delpkI", "sigmaI2", "delpkI2", "delIc"})
    same("TrilinearTraction", without({left_out, "kIe"}), reference, 1e-8);
  for (const char* one : {"sigmaI", "delpkI"})
    for (const char* left_out : {"sigmaI2", "delpkI2", "delIc", "JIc"})
      same("TrilinearTraction", without({left_out, one}), reference, 1e-8);
}

TEST_CASE("missing and contradictory properties of traction laws are explained", "[traction]") {
  using Catch::Contains;
  const Properties sliding{{"sigmaII", "2"}, {"delIIc", "0.6"}};
  CHECK_THAT(complaints("12", {{"sigmaI", "3"}, {"delIc", "0.4"}}),
             Contains("sliding (mode II): give two of <sigmaII>, <JIIc> and <delIIc>"));
  CHECK_THAT(complaints("12", sliding + Properties{{"sigmaI", "3"}, {"delIc", "0.4"}, {"JIc", "0.7"}}),
             Contains("contradict") && Contains("<JIc>"));
  CHECK(complaints("12", sliding + Properties{{"sigmaI", "3"}, {"delIc", "0.4"}, {"JIc", "0.6"}}).empty());
  CHECK_THAT(complaints("12", sliding + Properties{{"sigmaI", "3"}, {"JIc", "0.6"}, {"kIe", "1"}}),
             Contains("no curve of this shape has them") && Contains("<kIe> is at least"));
  CHECK_THAT(complaints("14", sliding + Properties{{"sigmaI", "3"}}),
             Contains("give two of <sigmaI>, <JIc> and <delIc>"));
  CHECK_THAT(complaints("20", sliding), Contains("give five of") && Contains("(0 are given)"));
  CHECK_THAT(complaints("TrilinearTraction", {{"sigmaI", "1"},
                                              {"delpkI", "0.1"},
                                              {"sigmaI2", "3"},
                                              {"delpkI2", "0.2"},
                                              {"delIc", "1"},
                                              {"sigmaII", "1"},
                                              {"delpkII", "0.1"},
                                              {"sigmaII2", "1"},
                                              {"delpkII2", "0.2"},
                                              {"delIIc", "1"}}),
             Contains("would become stiffer"));
  CHECK_THAT(complaints("34", sliding + Properties{{"sigmaI", "3"}, {"delIc", "0.4"}}), Contains("give <alphaI>"));
  CHECK_THAT(complaints("33", sliding + Properties{{"sigmaI", "3"}, {"delIc", "0.4"}, {"modelI", "13"}}),
             Contains("<modelI> must be 12 (triangular)"));
  CHECK_THAT(complaints("26", {{"stress", "1"}, {"function", "t"}}), Contains("exclude each other"));
  CHECK_THAT(complaints("12", sliding + Properties{{"sigmaI", "-3"}, {"delIc", "0.4"}}), Contains("> 0"));
}

TEST_CASE("curves: the displacement at a damage", "[traction]") {
  for (const auto& curve : {piecewise_curve(0.1, 3, 0.1, 3, 0.4), piecewise_curve(0.04, 3, 0.12, 1, 0.4),
                            cubic_curve(3, 0.4), exponential_curve(0.1, 3, 0.4, 2.5)}) {
    for (const double D : {0.0, 0.01, 0.3, 0.8, 0.999})
      CHECK(curve->damage(curve->at_damage(D)) == Approx(D).margin(1e-12));
    CHECK(curve->at_damage(1) == near(0.4));
    double sum = 0;
    for (int k = 0; k < 4000; ++k) sum += curve->traction((k + 0.5) * 1e-4) * 1e-4;
    CHECK(curve->toughness() == Approx(sum).epsilon(1e-6));
    CHECK(curve->dissipated(0.4) == near(curve->toughness()));
  }
}
