// SPDX-License-Identifier: MIT
/// The joint law Mohr against closed forms. A = 0.5, k_n = 2e9, k_s = 1e9 unless said otherwise.

#include "contact/joint_cases.hpp"

#include <cmath>
#include <numbers>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double kA = 1e9, sA = 5e8;  // k_n A, k_s A
const Properties base{{"stiffness-normal", "2e9"}, {"stiffness-shear", "1e9"}};
/// c = 500 kPa, phi = 30 at the peak, 100 kPa and 20 degrees left, under 1 MPa.
const Properties weakening = base + Properties{{"cohesion", "5e5"},
                                               {"friction", "30"},
                                               {"cohesion-residual", "1e5"},
                                               {"friction-residual", "20"},
                                               {"stress-normal", "-1e6"}};
constexpr double peak = 538675.1345948129, residual = 231985.11713310116;

Contact joint(const Properties& properties) {
  JointSite site;
  site.area = 0.5;
  return {"Mohr", properties, site};
}
double tangent(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

}  // namespace

TEST_CASE("TM1: an intact joint is elastic", "[mohr]") {
  auto j = joint(base + Properties{{"cohesion", "1e9"}, {"tension", "1e9"}});
  j.move(-1e-5).shear(3e-5, -4e-5);
  CHECK(j.joint.Fn == near(-1e4));
  CHECK(j.joint.Fs.s == near(-1.5e4));
  CHECK(j.joint.Fs.t == near(2e4));
  CHECK(j.joint.strain == near(0.675));
  CHECK(j.joint.state == 0);
}

TEST_CASE("TM2: a joint fails in tension, opens, and carries pressure by its overlap only after closing", "[mohr]") {
  auto j = joint(base +
                 Properties{{"tension", "1e6"}, {"cohesion", "2e6"}, {"friction", "30"}, {"friction-residual", "30"}});
  j.shear(1e-4).move(4e-4);
  CHECK(j.joint.Fn == near(4e5));
  CHECK(j.joint.Fs.s == near(-5e4));
  j.move(2e-4);
  CHECK(j.joint.Fn == near(5e5));
  CHECK(j.joint.Fs.norm() == 0);
  CHECK(j.joint.state == 2);
  REQUIRE(j.count(JointEvent::Kind::bond_break) == 1);
  CHECK(j.events.back().mode == 1);
  CHECK(j.events.back().strength == near(1e6));
  j.move(1e-5);
  CHECK(j.joint.Fn == 0);
  CHECK(j.joint.state == 8);
  CHECK(j.joint.away);
  j.move(-7.1e-4);
  CHECK(j.joint.Fn == near(-1e5));
  CHECK_FALSE(j.joint.away);
}

TEST_CASE("a joint that fails in tension and shear in one step has failed in tension", "[mohr]") {
  const Properties weak = base + Properties{{"tension", "1e6"}, {"cohesion", "1e5"}, {"cohesion-residual", "5e4"}};
  for (const bool holds : {false, true}) {
    auto j = joint(weak + Properties{{"tension-residual", holds ? "2e5" : "0"}});
    j.move(1e-3, {1e-2, 0});  // trial 2e6 in tension, 1e7 in shear
    CHECK(j.joint.Fn == near(5e5));
    CHECK(j.joint.Fs.norm() == near(holds ? 5e4 : 0.0));
    REQUIRE(j.count(JointEvent::Kind::bond_break) == 1);
    for (const JointEvent& e : j.events)
      if (e.kind == JointEvent::Kind::bond_break) {
        CHECK(e.mode == 1);
        CHECK(e.strength == near(1e6));
      }
    CHECK(j.state() == (holds ? "slip-n tension-n" : "tension-n"));
  }
}

TEST_CASE("TM2b: a stressed joint that has slipped stays active until its force is gone", "[mohr]") {
  auto j = joint(base + Properties{{"friction", "30"}, {"friction-residual", "30"}, {"stress-normal", "-4e5"}});
  j.shear(1e-3).move(1e-4);
  CHECK(j.joint.Fn == near(-1e5));
  CHECK_FALSE(j.joint.away);
  j.move(1.5e-4);
  CHECK(j.joint.Fn == 0);
  CHECK(j.joint.away);
}

TEST_CASE("TM3: residual tension", "[mohr]") {
  const Properties tearing =
      base +
      Properties{{"tension", "1e6"}, {"tension-residual", "2.5e5"}, {"friction", "45"}, {"friction-residual", "30"}};
  auto j = joint(tearing + Properties{{"cohesion", "3e6"}, {"cohesion-residual", "5e5"}});
  j.move(6e-4);
  CHECK(j.joint.Fn == near(5e5));
  j.move(1e-6, {2e-3, 0});
  CHECK(j.joint.Fn == near(1.25e5));
  CHECK(j.joint.Fs.norm() == near(177831.21635129678));
  CHECK(j.joint.state == 11);

  auto loose = joint(tearing);  // no cohesion: beyond the apex nothing is carried
  loose.move(6e-4).move(1e-6, {2e-3, 0});
  CHECK(loose.joint.Fs.norm() == 0);
}

TEST_CASE("TM4: without a slip length the strength drops to the residual value at the first slip", "[mohr]") {
  auto j = joint(weakening);
  int steps = 0;
  while (!j.joint.slips) {
    if (++steps == 10) CHECK(j.joint.Fs.norm() == near(9 * sA * 1e-5));
    j.shear(1e-5);
  }
  CHECK(steps == 108);
  CHECK(j.joint.Fs.norm() == near(peak));
  CHECK(j.joint.state == 1);
  j.shear(1e-5);
  CHECK(j.joint.Fs.norm() == near(residual));
  CHECK(j.joint.state == 5);
  j.shear(-1e-5);
  CHECK(j.joint.Fs.norm() == near(226985.11713310116));
  CHECK(j.joint.state == 4);
  REQUIRE(j.events.size() == 3);
  CHECK(j.count(JointEvent::Kind::bond_break) == 1);
  CHECK(j.events[0].mode == 2);
}

TEST_CASE("TM5: slip weakening begins with the first slip and ends after the slip length", "[mohr]") {
  auto j = joint(weakening + Properties{{"slip-dc", "2e-3"}});
  j.slide(108, 1e-5);
  CHECK(j.joint.Fs.norm() == near(peak));
  j.slide(100, 1e-5);
  CHECK(j.joint.Fs.norm() == near(385330.125863957));
  j.slide(100, 1e-5);
  CHECK(j.joint.Fs.norm() == near(residual));
  j.slide(50, 1e-5);
  CHECK(j.joint.Fs.norm() == near(residual));
  CHECK(j.joint.slip == near(2.5e-3));
}

TEST_CASE("TM6: a table of weakening", "[mohr]") {
  auto j = joint(weakening + Properties{{"slip-table", "1 0, 0.4 0.5e-3, 0 2e-3"}});
  j.slide(108, 1e-5);
  j.slide(25, 1e-5);
  CHECK(j.joint.Fs.norm() == near(446668.12935629935));
  j.slide(25, 1e-5);
  CHECK(j.joint.Fs.norm() == near(354661.12411778583));
  j.slide(75, 1e-5);
  CHECK(j.joint.Fs.norm() == near(293323.1206254435));
  j.slide(80, 1e-5);
  CHECK(j.joint.Fs.norm() == near(residual));

  auto line = joint(weakening + Properties{{"slip-table", "(1, 0) (0, 2e-3)"}});  // the slip length as a table
  line.slide(208, 1e-5);
  CHECK(line.joint.Fs.norm() == near(385330.125863957));
}

TEST_CASE("TM7: healing restores the shear strength", "[mohr]") {
  for (const auto* length : {"2e-3", "0"})
    for (const bool heals : {false, true}) {
      INFO("slip length " << length << ", healing " << heals);
      auto j = joint(weakening + Properties{{"slip-dc", length}, {"healing", heals ? "1" : "0"}});
      const int slides = std::string(length) == "0" ? 20 : 220;
      j.slide(107 + slides + 1, 1e-5).slide(5, -1e-5);
      const double kept = j.joint.slip;
      if (slides == 220) CHECK(kept == near(heals ? 0.0 : 2.21e-3));
      double most = 0;
      for (int k = 0; k < 400 && !j.joint.slips; ++k) j.shear(1e-5), most = std::max(most, j.joint.Fs.norm());
      CHECK(most == near(heals ? peak : residual));
    }
}

TEST_CASE("TM8: dilation between fixed faces increases the compression", "[mohr]") {
  const Properties held = base + Properties{{"friction", "30"}, {"friction-residual", "30"}, {"stress-normal", "-1e6"}};
  auto j = joint(held + Properties{{"dilation", "10"}, {"dilation-residual", "10"}, {"dilation-zero", "5.005e-3"}});
  j.slide(600, 1e-5);
  CHECK(j.joint.Fn == near(-1281128.5245385));
  CHECK(j.joint.Fs.norm() == near(739659.898508811));

  auto fading = joint(held + Properties{{"dilation", "10"}, {"dilation-residual", "2"}, {"slip-dc", "1e-3"}});
  while (fading.joint.slip < 0.5e-3 - 1e-9) fading.shear(1e-5);
  CHECK(fading.joint.Fn == near(-571897.4682311857));
}

TEST_CASE("stress-shear is the traction on body 2, which a shear displacement along it reduces", "[mohr]") {
  auto both = joint(base + Properties{{"stress-shear", "2e4 3e4"}, {"cohesion", "1e9"}});
  CHECK(both.joint.Fs.s == near(0.5 * 2e4));
  CHECK(both.joint.Fs.t == near(0.5 * 3e4));
  both.shear(1e-5, -1e-5);
  CHECK(both.joint.Fs.s == near(0.5 * 2e4 - sA * 1e-5));
  CHECK(both.joint.Fs.t == near(0.5 * 3e4 + sA * 1e-5));
  const auto one = joint(base + Properties{{"stress-shear", "3e4"}, {"cohesion", "1e9"}});
  CHECK(one.joint.Fs.s == 0);
  CHECK(one.joint.Fs.t == near(0.5 * 3e4));
}

TEST_CASE("a positive dilation compresses a joint between fixed faces for either direction of shear", "[mohr]") {
  const Properties held = base + Properties{{"friction", "30"},
                                            {"friction-residual", "30"},
                                            {"dilation", "10"},
                                            {"dilation-residual", "10"},
                                            {"stress-normal", "-1e6"}};
  auto forth = joint(held), back = joint(held);
  forth.slide(200, 1e-5), back.slide(200, -1e-5);
  CHECK(forth.joint.Fn < -0.5e6);
  CHECK(back.joint.Fn == forth.joint.Fn);
}

TEST_CASE("TM9: pore pressure reduces the strength and not the force", "[mohr]") {
  const Properties wet = base + Properties{{"friction", "30"}, {"friction-residual", "30"}, {"pore-pressure", "4e5"}};
  auto j = joint(wet + Properties{{"stress-normal", "-1e6"}});
  j.slide(100, 1e-5);
  CHECK(j.joint.Fn == near(-5e5));
  CHECK(j.own("stress_effective") == near(-6e5));
  CHECK(j.joint.Fs.norm() == near(173205.0807568877));

  auto open = joint(wet + Properties{{"stress-normal", "-3e5"}});  // the fluid carries the load
  open.shear(1e-5);
  CHECK(open.joint.Fn == near(-2e5));
  CHECK(open.joint.Fs.norm() == 0);
  CHECK(open.joint.state == 2);

  for (const bool keeps : {false, true}) {
    auto wide = joint(wet + Properties{{"stress-normal", "-3e5"}, {"keep-pressure-when-open", keeps ? "1" : "0"}});
    wide.shear(1e-5).move(1e-3);
    CHECK(wide.joint.away);
    CHECK(wide.joint.Fn == near(keeps ? -2e5 : 0.0));
    CHECK(wide.joint.strain == near(keeps ? 0.5 * 2e5 * 2e5 / (2e9 * wide.joint.area) : 0.0));
  }
}

TEST_CASE("TM10: dashpots and their modes", "[mohr]") {
  for (int mode = 0; mode < 4; ++mode) {
    INFO("mode " << mode);
    const Properties damped = base + Properties{{"friction", "30"},
                                                {"friction-residual", "30"},
                                                {"dashpot-ratio-normal", "0.2"},
                                                {"dashpot-ratio-shear", "0.1"},
                                                {"dashpot-mode", std::to_string(mode)}};
    auto j = joint(damped + Properties{{"stress-normal", "-1e6"}});
    j.mass = 2;
    j.slide(100, 1e-5);
    j.dt = 1.0;
    j.move(1e-5, {2e-3, 0});
    REQUIRE(j.joint.slips);
    CHECK(j.joint.dashpot_normal == near(0.1788854381999832));
    CHECK(j.joint.dashpot_shear.s == near(mode & 2 ? 0.0 : -12.649110640673518));

    auto still = joint(damped + Properties{{"cohesion", "1e9"}, {"cohesion-residual", "1e9"}, {"tension", "1e3"}});
    still.mass = 2;
    still.move(-5e-11 * 1.0 - 5e-5).move(5e-5);  // ends at F_n = -0.05 while it opens with 5e-5
    CHECK(still.joint.Fn == Approx(-0.05).epsilon(1e-5));
    CHECK(still.joint.dashpot_normal == Approx(mode & 1 ? 0.05 : 0.894427190999916).epsilon(1e-5));
  }
}

TEST_CASE("TM11: the energy balance of a sliding joint closes", "[mohr]") {
  auto j = joint(base + Properties{{"friction", "30"}, {"friction-residual", "30"}, {"stress-normal", "-1e6"}});
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double turnover = 0;
  for (int k = 0; k < 2000; ++k) {
    const double slid = j.joint.slid;
    j.shear(2e-4 * normal(random), 2e-4 * normal(random));
    CHECK(j.joint.slid <= slid);
    turnover += slid - j.joint.slid;
  }
  CHECK(turnover > 1e3);
  CHECK(std::abs(j.joint.released()) < 1e-12 * turnover);

  auto one_way = joint(base + Properties{{"friction", "30"}, {"friction-residual", "30"}, {"stress-normal", "-1e6"}});
  one_way.slide(1000, 1e-5);
  CHECK(one_way.joint.slid == near(-2720.0798102227777));
}

TEST_CASE("TM12: the shear force is scaled along the direction of its trial value", "[mohr]") {
  auto j = joint(base + Properties{{"friction", "30"}, {"friction-residual", "30"}, {"stress-normal", "-1e6"}});
  j.shear(1e-2);
  const double limit = 288675.1345948129;
  CHECK(j.joint.Fs.s == near(-limit));
  // as much along t that the trial lies at 60 degrees
  j.shear(0, limit * std::sqrt(3.0) / sA);
  CHECK(j.joint.Fs.norm() == near(limit));
  CHECK(j.joint.Fs.s / limit == near(-0.5));
  CHECK(j.joint.Fs.t / limit == near(-std::sqrt(0.75)));
}

TEST_CASE("TM13: the state in words", "[mohr]") {
  auto j = joint(base + Properties{{"state", "9"}});
  CHECK(j.state() == "slip-n tension-p");
  CHECK(joint(base).state().empty());
  CHECK(joint(base + Properties{{"state", "15"}}).state() == "slip-n tension-n slip-p tension-p");
}

TEST_CASE("TM14: shear under constant load opens a dilating joint", "[mohr]") {
  auto j = joint(base + Properties{{"friction", "30"},
                                   {"friction-residual", "30"},
                                   {"dilation", "10"},
                                   {"dilation-residual", "10"},
                                   {"dilation-zero", "5.005e-3"},
                                   {"stress-normal", "-1e6"}});
  for (int k = 0; k < 600; ++k) {
    // the load opens the joint by the compression caused by dilation in the preceding step
    const double lift = (-5e5 - j.joint.Fn) / kA;
    j.move(lift, {1e-5, 0});
  }
  j.move((-5e5 - j.joint.Fn) / kA);
  CHECK(j.joint.Fn == near(-5e5));
  CHECK(j.joint.Fs.norm() / 0.5 == near(577350.2691896257));
  CHECK(j.joint.opening == near(0.0007811285245384998));
  CHECK_FALSE(j.joint.away);
  CHECK(j.joint.gap > 0);
}

TEST_CASE("TM15: shear against a spring raises the normal stress", "[mohr]") {
  auto j = joint(base + Properties{{"friction", "30"},
                                   {"friction-residual", "30"},
                                   {"dilation", "10"},
                                   {"dilation-residual", "10"},
                                   {"stress-normal", "-1e6"}});
  const double K = 5e8 * 0.5;
  const auto settle = [&] {  // opening until the spring, K times the opening, presses as much as the joint does
    const double out_of_balance = -5e5 - K * j.joint.opening - j.joint.Fn;
    return out_of_balance / (kA + K);
  };
  for (int k = 0; k < 300; ++k) j.move(settle(), {1e-5, 0});
  j.move(settle());
  const double slope = tangent(10) * 2e9 * 5e8 / 2.5e9, onset = 577350.2691896257 / 1e9;
  CHECK(-j.joint.Fn / 0.5 == Approx(1e6 + slope * (3e-3 - onset)).epsilon(2e-3));
  CHECK(-j.joint.Fn / 0.5 == Approx(1170871.4049391875).epsilon(2e-3));
}

TEST_CASE("TM16: the strength envelope", "[mohr]") {
  for (const double sigma : {0.0, 5e5, 2e6}) {
    auto j = joint(base + Properties{{"cohesion", "3e5"},
                                     {"friction", "35"},
                                     {"friction-residual", "35"},
                                     {"stress-normal", std::to_string(-sigma)}});
    j.shear(1.0);
    CHECK(j.joint.Fs.norm() / 0.5 == near(3e5 + sigma * tangent(35)));
  }
}

TEST_CASE("TM17: tensile failure removes the cohesion for every kind of weakening", "[mohr]") {
  for (const auto& how : {Properties{}, Properties{{"slip-dc", "1e-3"}}, Properties{{"slip-table", "1 0, 0 1e-3"}}}) {
    auto j =
        joint(base + how +
              Properties{{"tension", "1e6"}, {"cohesion", "2e6"}, {"friction", "30"}, {"friction-residual", "20"}});
    j.move(6e-4).move(1e-4).move(-1.2e-3);
    CHECK(j.joint.Fn == near(-5e5));
    j.shear(1e-2);
    CHECK(j.joint.Fs.norm() == near(181985.117));
  }
}

TEST_CASE("TM19: a block slides down a joint", "[mohr]") {
  const double m = 1000, g = 10, theta = 35 * std::numbers::pi / 180, k = 1e8;
  const double W = m * g * std::sin(theta), N = m * g * std::cos(theta), dt = 1e-5;
  JointSite site;
  site.area = 1;
  Contact j("Mohr",
            {{"stiffness-normal", "1e8"},
             {"stiffness-shear", "1e8"},
             {"friction", "25"},
             {"friction-residual", "25"},
             {"stress-normal", std::to_string(-N)}},
            site);
  double v = 0, u = 0;
  for (int n = 0; n < 100000; ++n) {
    v += (W + j.joint.Fs.s) / m * dt;
    j.shear(v * dt), u += v * dt;
  }
  const double a = g * (std::sin(theta) - std::cos(theta) * tangent(25));
  CHECK(a == near(1.91599565, 1e-8));
  const double x1 = N * tangent(25) / k, omega = std::sqrt(k / m), t1 = std::acos(1 - x1 * k / W) / omega;
  const double v1 = W / std::sqrt(k * m) * std::sin(omega * t1);
  CHECK(v == Approx(v1 + a * (1 - t1)).epsilon(5e-4));
  CHECK(u == Approx(x1 + v1 * (1 - t1) + 0.5 * a * (1 - t1) * (1 - t1)).epsilon(5e-4));
  CHECK(v == Approx(1.92564).epsilon(2e-4));
}

TEST_CASE("D2: stick-slip, and the condition for stable sliding", "[mohr]") {
  // A mass m on a joint is drawn by a spring K that creeps forward; each event overshoots to the far side.
  const double m = 1000, K = 1e7;
  const double P = 500000 * tangent(30), R = 500000 * tangent(20);
  const auto slip_of_event = [&](const Properties& more) {
    JointSite site;
    site.area = 0.5;
    Contact j("Mohr",
              Properties{{"stiffness-normal", "2e9"},
                         {"stiffness-shear", "1e11"},
                         {"friction", "30"},
                         {"friction-residual", "20"},
                         {"healing", "1"},
                         {"stress-normal", "-1e6"}} +
                  more,
              site);
    const double dt = 0.2 * std::sqrt(m / 5e10);
    double v = 0, u = 0, drawn = 0.999 * P / K, before = 0;
    bool moved = false;
    double largest = 0;
    for (int n = 0; n < 2000000; ++n) {
      drawn += 1e-3 * dt;
      v += (K * (drawn - u) + j.joint.Fs.s) / m * dt;
      j.shear(v * dt), u += v * dt;
      if (j.joint.slips && !moved) moved = true, before = u;
      largest = std::max(largest, K * (drawn - u));
      if (moved && !j.joint.slips && v <= 0) break;
    }
    return std::pair{u - before, K * (drawn - u)};
  };
  const auto [slip, left] = slip_of_event({});
  CHECK(slip == Approx(2 * (P - R) / K).epsilon(0.02));
  CHECK(left == Approx(2 * R - P).epsilon(0.02));
}

TEST_CASE("joints heal only with healing 1, and tensile strength is never restored", "[mohr]") {
  auto j = joint(
      base +
      Properties{
          {"tension", "1e6"}, {"cohesion", "2e6"}, {"friction", "30"}, {"friction-residual", "20"}, {"healing", "1"}});
  j.move(6e-4).move(1e-4).move(-1.2e-3);
  j.shear(1e-2);
  CHECK(j.joint.Fs.norm() == near(0.5 * 2e6 + 5e5 * tangent(30)));
  j.shear(-1e-4).move(6e-4);
  CHECK(j.joint.Fn == 0);
}

TEST_CASE("the response of a mirrored joint is mirrored", "[mohr]") {
  auto a = joint(weakening), b = joint(weakening);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 300; ++k) {
    const double n = 1e-6 * normal(random), s = 3e-5 * normal(random), t = 3e-5 * normal(random);
    a.move(n, {s, t}), b.move(n, {-s, -t});
    CHECK(a.joint.Fn == b.joint.Fn);
    CHECK(a.joint.Fs.s == -b.joint.Fs.s);
    CHECK(a.joint.Fs.t == -b.joint.Fs.t);
  }
}

TEST_CASE("invalid properties of Mohr are reported", "[mohr]") {
  CHECK(complaints("Mohr", {{"friction", "95"}}).find("must be in [0, 90)") != std::string::npos);
  CHECK(complaints("Mohr", {{"healing", "0.5"}}).find("whole number") != std::string::npos);
  CHECK(complaints("Mohr", {{"slip-table", "1 0, 0.5 2, 0 1"}}).find("not sorted") != std::string::npos);
  CHECK(complaints("Mohr", {{"slip-table", "1 0 0.5"}}).find("pairs") != std::string::npos);
  CHECK(complaints("Mohr", {{"slip", "1"}}).find("is a result") != std::string::npos);
  CHECK(complaints("Mohr", {{"cohesoin", "1"}}).find("did you mean 'cohesion'") != std::string::npos);
  CHECK(complaints("Mohr", {{"bond", ""}}).find("is not a property") != std::string::npos);
  CHECK(complaints("Mohr", {{"stress-normal", "1"}, {"force-normal", "1"}}).find("exclude each other") !=
        std::string::npos);
  const auto warned = complaints("Mohr", {{"friction", "30"}, {"cohesion", "1"}});
  CHECK(warned.find("warning: <friction-residual> is not given") != std::string::npos);
  CHECK(complaints("Mohr", {{"friction", "30"}, {"friction-residual", "0"}}).empty());
}

TEST_CASE("a joint that failed before and starts open presses by its overlap only", "[mohr]") {
  JointSite site;
  site.area = 0.5, site.gap = 3e-4;
  const Properties failed = base + Properties{{"state", "4"}};
  Contact at_once("Mohr", failed, site), slowly("Mohr", failed, site);
  CHECK(at_once.joint.away);
  at_once.move(-4e-4);  // overlap 1e-4
  slowly.move(-2e-4).move(-2e-4);
  CHECK(at_once.joint.Fn == near(-1e5));
  CHECK(slowly.joint.Fn == near(-1e5));
  Contact shifted("Mohr", failed + Properties{{"rgap", "3e-4"}}, site);
  CHECK_FALSE(shifted.joint.away);
  CHECK(shifted.move(-1e-4).joint.Fn == near(-1e5));
  // under a stress at the start it opens once this is gone
  site.gap = 0;
  Contact stressed("Mohr", failed + Properties{{"stress-normal", "-4e5"}}, site);
  CHECK(stressed.move(1e-4).joint.Fn == near(-1e5));
  CHECK(stressed.move(1.5e-4).joint.Fn == 0);
  CHECK(stressed.move(-3.5e-4).joint.Fn == near(-3e5));
}

TEST_CASE("the event of a failed joint has the strength and the force of its step", "[mohr]") {
  auto sheared = joint(weakening);
  sheared.move(1e-4, {1e-2, 0});  // N = -4e5 in the failing step, -5e5 before
  const double strength = 5e5 + 8e5 * tangent(30);
  REQUIRE(sheared.count(JointEvent::Kind::bond_break) == 1);
  CHECK(sheared.events[0].mode == 2);
  CHECK(sheared.events[0].strength == near(strength));
  CHECK(sheared.events[0].force == near(0.5 * strength));
  auto torn = joint(base + Properties{{"tension", "1e6"}, {"cohesion", "1e9"}, {"pore-pressure", "2e5"}});
  torn.move(1e-3);
  REQUIRE(torn.events.size() == 1);
  CHECK(torn.events[0].mode == 1);
  CHECK(torn.events[0].strength == near(1e6));
  CHECK(torn.events[0].force == near(0.5 * (1e6 - 2e5)));
}

TEST_CASE("a healed joint that fails again sends its event again", "[mohr]") {
  for (const bool heals : {true, false}) {
    INFO((heals ? "heals" : "does not heal"));
    auto j = joint(weakening + Properties{{"healing", heals ? "1" : "0"}});
    j.slide(120, 1e-5).slide(5, -1e-5);
    REQUIRE(j.count(JointEvent::Kind::bond_break) == 1);
    j.slide(150, 1e-5);
    REQUIRE(j.count(JointEvent::Kind::bond_break) == (heals ? 2 : 1));
    CHECK(j.joint.Fs.norm() == near(residual));
    j.slide(20, -1e-5);
    j.move(2e-3);  // pulled apart
    CHECK(j.count(JointEvent::Kind::bond_break) == (heals ? 3 : 1));
    for (const JointEvent& e : j.events)
      if (e.kind == JointEvent::Kind::bond_break && e.mode == 2) CHECK(e.strength == near(2 * peak));
    j.move(1e-4);
    CHECK(j.count(JointEvent::Kind::bond_break) == (heals ? 3 : 1));
  }
  // a step that heals may also be one that slips again
  auto big = joint(weakening + Properties{{"healing", "1"}});
  big.shear(1e-2).shear(-7e-4).shear(1e-2);
  CHECK(big.count(JointEvent::Kind::bond_break) == 2);
}

TEST_CASE("faces that separate after they have slipped have no cohesion left", "[mohr]") {
  const Properties glued =
      base + Properties{{"cohesion", "5e5"}, {"friction", "30"}, {"friction-residual", "20"}, {"slip-dc", "100"}};
  const auto strength = [&](bool apart) {
    auto j = joint(glued);
    j.move(-1e-4).shear(1e-2, 0).shear(1e-5, 0);  // slips by far less than slip-dc
    CHECK(j.joint.shear_weak);
    if (apart) j.move(2e-4).move(-2e-4);
    j.shear(1e-2, 0);
    return std::abs(j.joint.Fs.s) / 0.5;
  };
  const double pressure = 1e-4 * 2e9;
  CHECK(strength(false) == Approx(5e5 + pressure * tangent(30)).epsilon(1e-3));
  CHECK(strength(true) == Approx(pressure * tangent(20)).epsilon(1e-9));
}
