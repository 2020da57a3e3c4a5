// SPDX-License-Identifier: MIT
/// The joint law SpringNetwork against closed forms: a square face of 10 x 10 mm, E = 50 GPa, d = 10 mm.

#include "contact/bond_cases.hpp"

#include <cmath>
#include <numbers>
#include <random>

using namespace tribo;
using namespace tribo::test;
using namespace tribo::test::bonds;

TEST_CASE("TS2: a bond is elastic in all six directions", "[spring_network]") {
  auto c = bond(strong);
  c.move(1e-6, {2e-7, -1e-7}, 1e-5, {1e-5, -2e-5});
  CHECK(c.joint.Fn == near(500));
  CHECK(c.joint.Fs.s == near(-100));
  CHECK(c.joint.Fs.t == near(50));
  CHECK(c.joint.Mt == near(-0.08333333333333333));
  CHECK(c.joint.Mb.s == near(-0.041666666666666664));
  CHECK(c.joint.Mb.t == near(0.08333333333333333));
  CHECK(c.own("sn_sigma") == near(5660554.549601002));
  CHECK(c.own("sn_tau") == near(1413442.963900814));
  CHECK(c.joint.strain == near(0.00026395833333333333));
  CHECK(c.joint.state == 3);
}

TEST_CASE("TS3: a bond fails in tension when the stress at its rim reaches the strength", "[spring_network]") {
  auto c = bond(brittle);
  c.move(0.999e-6);
  CHECK(c.joint.state == 3);
  c.move(0.002e-6);
  CHECK(c.joint.state == 1);
  CHECK(c.joint.Fn == 0);
  CHECK(c.joint.gap - c.joint.rest_gap == near(1.001e-6));
  CHECK(last_break(c).mode == 1);
  CHECK(last_break(c).strength == near(5e6));
  CHECK(last_break(c).energy == near(0.00025050025));

  const double theta = 5e6 * I / (R * k_bend);
  CHECK(theta == near(1.692569e-4, 1e-6));
  auto bent = bond(brittle);
  bent.move(0, {}, 0, {0.999 * theta, 0});
  CHECK(bent.joint.state == 3);
  bent.move(0, {}, 0, {0.002 * theta, 0});
  CHECK(bent.joint.state == 1);
  CHECK(bent.joint.Mb.norm() == 0);
  auto stiff = bond(brittle + Properties{{"sn_mcf", "0"}});
  stiff.move(0, {}, 0, {100 * theta, 0});
  CHECK(stiff.joint.state == 3);
}

TEST_CASE("TS4: a bond fails in shear at its cohesion and friction, then slides with friction", "[spring_network]") {
  auto c = bond(rock);
  c.move(-2e-6);
  REQUIRE(c.joint.Fn == near(-1000));
  CHECK(c.own("sn_shear") == near(15773502.691896256));
  CHECK(slide_to_break(c) <= 1577.3502691896256);
  CHECK(c.joint.shear.s * kA == Approx(1577.3502691896256).epsilon(1e-3));
  CHECK(c.joint.state == 2);
  CHECK(c.joint.Fs.norm() == near(577.3502691896257));
  CHECK(last_break(c).mode == 2);
  CHECK(last_break(c).strength == near(15773502.691896256));
  CHECK(c.joint.slips);

  auto residual = bond(rock + Properties{{"sn_cohres", "2e6"}, {"fric", "0.4"}});
  residual.move(-2e-6);
  slide_to_break(residual);
  CHECK(residual.joint.Fs.norm() == near(600));

  auto pulled = bond(rock);
  pulled.move(0.6e-6);
  CHECK(pulled.own("sn_shear") == near(8267949.192431123));

  const double twist = 10e6 * J / R / k_twist;
  auto twisted = bond(rock);
  twisted.move(0, {}, 0.999 * twist);
  CHECK(twisted.joint.state == 3);
  twisted.move(0, {}, 0.002 * twist);
  CHECK(twisted.joint.state == 2);
}

TEST_CASE("TS5: softening follows its line for any step", "[spring_network]") {
  for (const double by : {1e-8, 3.7e-7}) {
    INFO("steps of " << by);
    auto c = bond(soft);
    double u = 0, work = 0;
    while (c.joint.state >= 3) {
      const double before = c.joint.Fn;
      c.move(by), u += by;
      work += 0.5 * (before + c.joint.Fn) * by;
      if (c.joint.state >= 3)
        CHECK(c.joint.Fn == near(u <= 1e-6 ? kA * u : 500 * (1 - (u - 1e-6) / 4e-6)).margin(1e-9));
    }
    CHECK(u >= 5e-6 - 1e-14);
    CHECK(u <= 5e-6 + by);
    if (by < 1e-7) CHECK(work == Approx(1.25e-3).epsilon(1e-4));
  }
  auto c = bond(soft);
  c.move(3e-6);
  CHECK(c.joint.Fn == near(250));
  CHECK(c.joint.state == 4);
  CHECK(c.joint.elongation == near(2e-6));
}

TEST_CASE("TS6: softening by a table", "[spring_network]") {
  auto c = bond(brittle + Properties{{"sn_tentab", "1 0, 0.3 1e-6, 0 4e-6"}});
  c.move(1.5e-6);
  CHECK(c.joint.Fn == near(325));
  c.move(0.5e-6);
  CHECK(c.joint.Fn == near(150));
  c.move(1.5e-6);
  CHECK(c.joint.Fn == near(75));
  c.move(2e-6);
  CHECK(c.joint.state == 1);
}

TEST_CASE("TS7: unloading is elastic, and reloading reaches the envelope where unloading began", "[spring_network]") {
  auto c = bond(soft);
  c.move(3e-6).move(-0.4e-6);
  CHECK(c.joint.Fn == near(50));
  CHECK(c.joint.state == 5);
  c.move(-0.3e-6);
  CHECK(c.joint.Fn == near(-100));
  c.move(0.69e-6);
  CHECK(c.joint.Fn == near(245));
  CHECK(c.joint.state == 5);
  c.move(1.01e-6);
  CHECK(c.joint.Fn == near(125));
  CHECK(c.joint.state == 4);

  const double theta = 5e6 * I / (R * k_bend);
  auto bent = bond(soft);
  bent.move(0, {}, 0, {3 * theta, 0});
  CHECK(bent.joint.Mb.norm() == near(0.3526184897173476));
}

TEST_CASE("a bond fails in shear while it softens and while it is unloaded", "[spring_network]") {
  const auto strength = [](double sigma) { return 10e6 - sigma * std::tan(std::numbers::pi / 6); };
  auto c = bond(rock + Properties{{"sn_tendc", "4e-6"}});
  c.move(3e-6, {1.7e-6, 0});
  CHECK(c.joint.state == 4);
  auto back = c;
  c.move(1e-7, {1e-7, 0});  // softens to 2.375 MPa
  CHECK(c.joint.state == 2);
  CHECK(last_break(c).mode == 2);
  CHECK(last_break(c).strength == near(strength(2.375e6)));
  CHECK(last_break(c).force == near(kA * 1.8e-6));
  CHECK(c.joint.Fn == 0);

  back.move(-0.4e-6, {0.2e-6, 0});
  CHECK(back.joint.state == 5);
  CHECK(back.own("sn_shear") == near(strength(0.5e6)));
  back.shear(0.05e-6);
  CHECK(back.joint.state == 2);
  CHECK(last_break(back).mode == 2);
  CHECK(last_break(back).strength == near(strength(0.5e6)));
  CHECK(last_break(back).force == near(kA * 1.95e-6));
}

TEST_CASE("TS8: cohesion that falls with slip, by length or table", "[spring_network]") {
  for (const bool table : {false, true}) {
    INFO((table ? "table" : "length"));
    auto c =
        bond(rock + (table ? Properties{{"sn_cohtab", "1 0, 0.2 4e-6, 0 1e-5"}} : Properties{{"sn_cohdc", "1e-5"}}));
    c.move(-2e-6);
    slide_to_break(c);
    CHECK(c.joint.Fs.norm() == near(1577.3502691896256));
    for (int k = 0; k < 40; ++k) {
      c.shear(2.5e-7);
      const double s = (k + 1) * 2.5e-7;
      const double m = !table ? 1 - s / 1e-5 : s < 4e-6 ? 1 - 0.8 * s / 4e-6 : 0.2 * (1e-5 - s) / 6e-6;
      CHECK(c.joint.Fs.norm() == near(577.3502691896257 + 1000 * std::max(0.0, m)));
    }
    CHECK(c.joint.Fs.norm() == near(577.3502691896257));
  }
}

TEST_CASE("TS9: a broken bond heals when sliding ends under pressure", "[spring_network]") {
  auto c = bond(rock + Properties{{"sn_heal", "1"}});
  c.move(-2e-6);
  slide_to_break(c);
  c.shear(1e-7).shear(-1e-9);
  CHECK(c.joint.state == 6);
  const double more = (0.999 * 1577.3502691896256 - c.joint.Fs.norm()) / kA;
  auto torn = c;
  c.shear(more);
  CHECK(c.joint.Fs.norm() == near(1575.772918920436));
  CHECK(c.joint.state == 6);
  c.shear(1e-8);
  CHECK(c.joint.state == 2);
  const double stored = torn.joint.strain;
  torn.move(2.1e-6);
  CHECK(torn.joint.state == 1);
  CHECK(stored > 0);
  CHECK(last_break(torn).energy == near(stored));  // a healed bond has no tensile strength: what it stored before
  CHECK(torn.joint.Fn == 0);
  CHECK(torn.joint.Fs.norm() == 0);
}

TEST_CASE("a healed bond has no fictitious force", "[spring_network]") {
  auto c = bond(rock + Properties{{"sn_heal", "1"}});
  c.poisson_normal = -20, c.poisson_shear = {5, 3};
  c.move(-2e-6);
  CHECK(c.joint.Fn == near(-1020));
  slide_to_break(c);
  c.shear(1e-7).shear(-1e-9);
  REQUIRE(c.joint.state == 6);
  const Joint before = c.joint;
  c.move(0);
  c.poisson_normal = -400, c.poisson_shear = {100, 0};
  c.move(0);
  CHECK(c.joint.Fn == before.Fn);
  CHECK((c.joint.Fs - before.Fs).norm() == 0);
  CHECK(c.joint.poisson_normal == 0);
}

TEST_CASE("TS10: the largest moments without a bond", "[spring_network]") {
  auto c = loose({{"fric", "0.5"}});
  c.move(-2e-6);
  c.events.clear();
  c.move(0, {}, 1.0, {1.0, 0});
  CHECK(c.joint.Mb.norm() == near(2.9619953136257204));
  CHECK(std::abs(c.joint.Mt) == near(1.833616146530208));
  REQUIRE(c.events.size() == 1);
  CHECK(c.events[0].mode == 6);
  CHECK((c.events[0].bend && c.events[0].twist && !c.events[0].shear));
}

TEST_CASE("TS11: without bond, from the gap or by increments", "[spring_network]") {
  Contact absolute("SpringNetwork", {{"kn", "5e12"}, {"ks", "5e12"}}, face());
  absolute.move(-2e-6);
  CHECK(absolute.joint.Fn == near(-1000));
  absolute.move(1e-6);
  CHECK(absolute.joint.Fn == near(-500));
  absolute.move(2e-6);
  CHECK(absolute.joint.Fn == 0);
  auto incremental = loose({});
  incremental.move(-2e-6);
  CHECK(incremental.joint.Fn == near(-1000));
  incremental.move(5e-6);
  CHECK(incremental.joint.Fn == 0);
}

TEST_CASE("TS12: dilation between fixed faces increases the compression, in both modes", "[spring_network]") {
  for (const char* mode : {"0", "1"}) {
    Contact c("SpringNetwork",
              {{"kn", "5e12"},
               {"ks", "5e12"},
               {"fric", "0.5"},
               {"sn_dil", "15"},
               {"sn_dilzero", "20.5e-6"},
               {"sn_mode", mode}},
              face());
    c.move(-2e-6);
    c.slide(300, 1e-7);
    const double expected = -1000 - 194 * kA * std::tan(std::numbers::pi / 12) * 1e-7;
    CHECK(c.joint.Fn == Approx(expected).epsilon(1e-3));
    CHECK(c.joint.Fn == Approx(-3599.10716658189).epsilon(1e-3));
  }
}

TEST_CASE("TS13: pore pressure causes tensile failure and reduces the strength", "[spring_network]") {
  auto c = bond(rock + Properties{{"sn_porp", "2e6"}});
  c.move(0.599e-6);
  CHECK(c.joint.state == 3);
  c.move(0.002e-6);
  CHECK(c.joint.state == 1);
  auto pressed = bond(rock + Properties{{"sn_porp", "4e6"}});
  pressed.move(-2e-6);
  CHECK(pressed.own("sn_shear") == near(13464101.615137754));
}

TEST_CASE("pore pressure reduces the friction of an unbonded contact", "[spring_network]") {
  const Properties springs{{"kn", "5e12"}, {"ks", "5e12"}, {"fric", "0.5"}};
  for (const char* mode : {"0", "1"})
    for (const auto& [pressure, friction] : {std::pair{"0", 500.0}, {"4e6", 300.0}, {"-4e6", 700.0}, {"1e7", 0.0}}) {
      INFO("mode " << mode << ", pressure " << pressure);
      Contact c("SpringNetwork", springs + Properties{{"sn_mode", mode}, {"sn_porp", pressure}}, face());
      c.move(-2e-6);
      CHECK(c.joint.Fn == near(-1000));
      c.shear(1e-5);
      CHECK(c.joint.Fs.s == near(-friction));
      CHECK(c.joint.Fs.t == 0);
    }
}

TEST_CASE("TS14: the energy balance of a contact that slides in shear, bending and twist closes", "[spring_network]") {
  auto c = loose({{"fric", "0.5"}});
  c.move(-2e-6);
  const double strain = c.joint.strain, work = c.joint.work;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double turnover = 0;
  for (int k = 0; k < 500; ++k) {
    const double slid = c.joint.slid;
    c.move(0, {1e-6 * normal(random), 1e-6 * normal(random)}, 1e-4 * normal(random),
           {4e-4 * normal(random), 4e-4 * normal(random)});
    CHECK(c.joint.slid <= slid);
    turnover += slid - c.joint.slid;
  }
  CHECK(turnover > 1e-2);
  CHECK(std::abs(c.joint.work - work - (c.joint.strain - strain) + c.joint.slid) < 1e-10 * turnover);
}

TEST_CASE("TS16: a constant fictitious force is applied only once", "[spring_network]") {
  auto c = bond(strong);
  c.poisson_normal = -20, c.poisson_shear = {5, 0};
  for (int k = 0; k < 10; ++k) c.move(0);
  CHECK(c.joint.Fn == near(-20));
  CHECK(c.joint.Fs.s == near(5));
}

TEST_CASE("TS17: the pressure is continuous at failure for any gap", "[spring_network]") {
  auto c = bond(rock);
  c.poisson_normal = -250;
  c.move(-1.5e-6);
  CHECK(c.joint.Fn == near(-1000));
  slide_to_break(c);
  CHECK(c.joint.state == 2);
  CHECK(c.joint.Fn == near(-1000));
  CHECK(c.joint.gap - c.joint.rest_gap == near(-2e-6));
  c.poisson_normal = 0;
  c.shear(1e-9);
  CHECK(c.joint.Fn == near(-1000));
}

TEST_CASE("TS18: events of slip", "[spring_network]") {
  auto c = loose({{"fric", "0.5"}});
  c.move(-2e-6).shear(2e-6).shear(-1e-7);
  REQUIRE(c.events.size() == 2);
  CHECK((c.events[0].mode == 1 && c.events[0].shear));
  CHECK((c.events[1].mode == 1 && !c.events[1].shear));
  c.move(3e-6).move(-2e-6);
  CHECK(c.count(JointEvent::Kind::activated) == 1);
}

TEST_CASE("TS19: a bond in two dimensions", "[spring_network]") {
  JointSite edge;
  edge.area = 0.02, edge.distance = 0.02;
  Contact c("SpringNetwork", Properties{{"compute-stiffness", "emod 50e9 poisson 0"}, {"bond", ""}} + strong, edge);
  CHECK(c.joint.kn == near(2.5e12));
  c.move(1e-7, {0, 2e-7}, 0, {1e-5, 0});
  CHECK(c.joint.Fn == near(5000));
  CHECK(c.joint.Fs.t == near(-1e4));
  CHECK(c.joint.Mb.s == near(-16.666666666666668));
  CHECK(c.own("sn_sigma") == near(5000 / 0.02 + 6 * 16.666666666666668 / (0.02 * 0.02)));
  CHECK(c.own("sn_sigma") == near(5e5));
}

TEST_CASE("D1: restitution of a ball with a dashpot", "[spring_network]") {
  for (const int mode : {0, 1})
    for (const double beta : {0.1, 0.2, 0.4}) {
      INFO("mode " << mode << ", beta " << beta);
      JointSite site;
      site.area = 1, site.plane = false;
      Contact c("SpringNetwork",
                {{"kn", "1e6"}, {"dp_nratio", std::to_string(beta)}, {"dp_mode", std::to_string(mode)}}, site);
      c.dt = 1e-6, c.mass = 1;
      double v = -1, x = 0;
      do {
        c.move(v * c.dt), x += v * c.dt;
        v -= (c.joint.Fn + c.joint.dashpot_normal) * c.dt;
      } while (x < 0);
      const double root = std::sqrt(1 - beta * beta);
      const double e =
          mode == 0 ? std::exp(-beta * std::numbers::pi / root)
                    : std::exp(-beta / root * (std::numbers::pi - std::atan2(2 * beta * root, 1 - 2 * beta * beta)));
      CHECK(v == Approx(e).epsilon(3e-3));
    }
}

TEST_CASE("Methods: bond and unbond by the gap, stiffness by its ratio", "[spring_network]") {
  const auto state_at = [](double gap, const char* range) {
    JointSite site = face();
    site.gap = gap;
    return Contact("SpringNetwork", {{"kn", "1e9"}, {"bond", range}}, site).joint.state;
  };
  CHECK(state_at(0, "") == 3);
  CHECK(state_at(1e-3, "") == 0);
  CHECK(state_at(1e-3, "gap 2e-3") == 3);
  CHECK(state_at(-1e-3, "gap 0 1") == 0);
  Contact c("SpringNetwork", {{"assign-stiffness", "kn 2e9 kratio 4"}, {"bond", ""}, {"unbond", ""}}, face());
  CHECK(c.joint.kn == near(2e9));
  CHECK(c.joint.ks == near(5e8));
  CHECK(c.joint.twist_stiffness == 0);
  CHECK(c.joint.state == 0);
  Contact area("SpringNetwork", {{"kn", "1e9"}, {"user_area", "3"}}, face());
  CHECK(area.joint.area == 3);
  // an open contact without bond keeps the force it is given
  JointSite open = face();
  open.gap = 2e-3;
  Contact pressed("SpringNetwork", {{"kn", "1e9"}, {"rgap", "1e-3"}, {"sn_force", "50 0 0"}, {"unbond", "gap 1"}},
                  open);
  CHECK(pressed.joint.Fn == near(-50));
  CHECK(pressed.move(0).joint.Fn == near(-50));
}

TEST_CASE("the moments of an elastic face resist bending along their own axes", "[spring_network]") {
  // turned by (w_s, w_t), the face opens by w_s t - w_t s at the point (s, t)
  JointSite skew = face();
  skew.moments = {2e-9, 1e-9, 0.5e-9};
  const Properties whole{{"compute-stiffness", "emod 50e9"}, {"bond", ""}, {"sn_ten", "1e30"}, {"sn_coh", "1e30"}};
  Contact about_s("SpringNetwork", whole, skew), about_t("SpringNetwork", whole, skew);
  about_s.move(0, {}, 0, {1e-6, 0}), about_t.move(0, {}, 0, {0, 1e-6});
  const double k = 50e9 / skew.distance * 1e-6;
  CHECK(about_s.joint.Mb.s == near(-k * 2e-9));
  CHECK(about_s.joint.Mb.t == near(k * 0.5e-9));
  CHECK(about_t.joint.Mb.s == near(k * 0.5e-9));
  CHECK(about_t.joint.Mb.t == near(-k * 1e-9));
}

TEST_CASE("invalid properties of SpringNetwork are reported", "[spring_network]") {
  const auto says = [](const Properties& p, const char* what) {
    return complaints("SpringNetwork", p).find(what) != std::string::npos;
  };
  CHECK(says({{"sn_fa", "90"}}, "must be in [0, 90)"));
  CHECK(says({{"sn_ten", "-1"}}, ">= 0"));
  CHECK(says({{"sn_tentab", "1 0, 0.5 0"}}, "not sorted"));
  CHECK(says({{"sn_tendc", "1"}, {"sn_tentab", "1 0, 0 1"}}, "exclude each other"));
  CHECK(says({{"emod", "1"}}, "compute-stiffness"));
  CHECK(says({{"compute-stiffness", "emod 1 posson 0.2"}}, "did you mean 'poisson'"));
  CHECK(says({{"compute-stiffness", "emod 1"}, {"kn", "1"}}, "leave one of them out"));
  CHECK(says({{"bond", "gap 2 1"}}, "a <= b"));
  CHECK(says({{"krot", "1 2"}}, "one number"));
  CHECK(says({{"sn_cohesion", "1"}}, "is not a property"));
  CHECK(complaints("SpringNetwork", {{"kn", "1"}, {"sn_ten", "1"}}).empty());
}
