// SPDX-License-Identifier: MIT
#include "contact/contact_cases.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

void check_impulse(const ContactResponse& got, double x, double y, double tolerance = 1e-13) {
  CHECK(got.impulse[0] == Approx(x).epsilon(0).margin(tolerance));
  CHECK(got.impulse[1] == Approx(y).epsilon(0).margin(tolerance));
  CHECK(got.impulse[2] == 0.0);
}

}  // namespace

TEST_CASE("frictional laws give the impulses of a hand calculation", "[contact]") {
  const ContactState m = plain_meeting();
  const auto frictionless = make_law("61", {})->response(m);
  check_impulse(frictionless, -0.8448, -0.6336);
  CHECK(energy_change(m, frictionless.impulse) == Approx(-0.46464).epsilon(1e-13));
  const auto stick = make_law("60", {})->response(m);
  check_impulse(stick, -2.4, 1.44);
  CHECK(energy_change(m, stick.impulse) == Approx(-3.264).epsilon(1e-13));
  const auto rubs = make_law("61", {{"coeff", "0.3"}})->response(m);
  check_impulse(rubs, -1.03488, -0.38016);
  CHECK(rubs.status == ContactStatus::slip);
  CHECK(energy_change(m, rubs.impulse) == Approx(-1.1071104).epsilon(1e-13));
  check_impulse(make_law("63", {{"coeff", "0.3"}, {"Sa", "800"}})->response(m), -1.15488, -0.22016);
  check_impulse(make_law("63", {{"coeff", "0.3"}, {"kmu", "0.05"}})->response(m), -1.09241379, -0.303448276, 1e-8);
  auto liquid = make_law("64", {{"coeff", "2"}, {"LiquidPhase", "1"}});
  liquid->set_viscosity([](double) { return 1000.0; });
  check_impulse(liquid->response(m), -1.30221176, -0.0237176471, 1e-8);
}

TEST_CASE("friction falls smoothly from static to dynamic", "[contact]") {
  ContactState m;
  m.mass = 1.2, m.dt = 1, m.area = 1;
  m.velocity = Vec3(-2 / 1.2, 1.5 / 1.2, 0);
  const auto got = make_law("63", {{"coeff", "0.3"}, {"coeffStatic", "0.5"}, {"vhalf", "0.2"}})->response(m);
  CHECK(got.impulse[1] == Approx(0.6915650514).epsilon(1e-9));
  const double v = (1.5 - got.impulse[1]) / 1.2;
  CHECK(got.impulse[1] == Approx(2 * (0.5 * 0.2 + 0.3 * v) / (0.2 + v)).epsilon(1e-12));
}

TEST_CASE("a gap may close but not become an overlap", "[contact]") {
  const auto law = make_law("61", {});
  ContactState m = plain_meeting();  // closes with 0.88
  m.gap = 0.88e-3 * 1.001;
  CHECK(law->response(m).status == ContactStatus::open);
  CHECK(law->response(m).impulse.norm() == 0.0);
  m.gap = 0.5e-3;
  const auto part = law->response(m);
  CHECK((m.velocity - part.impulse / m.mass).dot(m.normal) == Approx(-0.5).epsilon(1e-13));
  m.gap = -1;
  CHECK(law->response(m).impulse.dot(m.normal) == Approx(-1.2 * 0.88).epsilon(1e-13));
  m.velocity = Vec3(0.8, 0.6, 0);  // parting: no tension, even while overlapping
  CHECK(law->response(m).impulse.norm() == 0.0);
}

TEST_CASE("contact may be held by overlap alone, or up to a tension", "[contact]") {
  ContactState m = plain_meeting();
  m.velocity = Vec3(0.8, 0.6, 0), m.gap = -1e-3;  // parting with 1: tension 1.2/(0.25e-3) = 4800
  CHECK(make_law("61", {{"displacementOnly", "1"}})->response(m).impulse.dot(m.normal) == Approx(1.2));
  CHECK(make_law("61", {{"displacementOnly", "-4801"}})->response(m).impulse.dot(m.normal) == Approx(1.2));
  CHECK(make_law("61", {{"displacementOnly", "-4799"}})->response(m).impulse.norm() == 0.0);
}

TEST_CASE("the tension that contact may bear is a stress, in legacy units in MPa", "[contact]") {
  ContactState m = plain_meeting();
  m.velocity = Vec3(0.8, 0.6, 0), m.gap = -1e-3;  // parting with 1: tension 4800 g/(mm s^2) = 0.0048 MPa
  const Units legacy{true, "mm", "g", "s"};
  CHECK(make_law("61", {{"displacementOnly", "-0.004801"}}, legacy)->response(m).impulse.dot(m.normal) == Approx(1.2));
  CHECK(make_law("61", {{"displacementOnly", "-0.004799"}}, legacy)->response(m).impulse.norm() == 0.0);
  CHECK(make_law("61", {{"displacementOnly", "1"}}, legacy)->response(m).impulse.dot(m.normal) == Approx(1.2));
}

TEST_CASE("compliant faces push back with their stiffness", "[contact]") {
  ContactState m = plain_meeting();
  m.gap = -0.01, m.velocity = m.start = Vec3(0, 0, 0);
  const auto law = make_law("61", {{"Dc", "1000"}});
  const double phi = 1e-3 * std::sqrt(1000 * 0.25 / 1.2);
  CHECK(law->response(m).impulse.dot(m.normal) ==
        Approx(-0.01 * 1000 * 0.25 * 1e-3 * (1 - phi * phi / 12)).epsilon(1e-6));
}

TEST_CASE("a negative coefficient sticks in contact and lets go", "[contact]") {
  const auto law = make_law("61", {{"coeff", "-1"}});
  check_impulse(law->response(plain_meeting()), -2.4, 1.44);
  ContactState m = plain_meeting();
  m.velocity = Vec3(0.8, 0.6, 0);
  CHECK(law->response(m).impulse.norm() == 0.0);
}

TEST_CASE("static friction holds until faces slide, and falls along the way they slid", "[contact]") {
  ContactState m;
  m.mass = 1, m.dt = 1, m.area = 1, m.cell = 2;
  m.velocity = Vec3(-1, 10, 0);
  for (const char* type : {"61", "63"}) {
    const auto law = make_law(type, {{"coeff", "0.3"}, {"coeffStatic", "0.7"}});
    const auto given = make_law(type, {{"coeff", "0.3"}, {"coeffStatic", "0.7"}, {"weakening", "0.5"}});
    const auto friction = [&](const ContactLaw& of, double slip) {
      m.slip = slip;
      return of.response(m).impulse[1];
    };
    CHECK(friction(*law, 0) == Approx(0.7));
    CHECK(friction(*law, 0.005) == Approx(0.6));
    CHECK(friction(*law, 0.02) == Approx(0.3));
    CHECK(friction(*given, 0.25) == Approx(0.5));
    CHECK(law->has_memory());
    const auto sudden = make_law(type, {{"coeff", "0.3"}, {"coeffStatic", "0.7"}, {"weakening", "0"}});
    for (const double slip : {0.0, 1e-12, 1.0}) {
      INFO("slip " << slip);
      CHECK(friction(*sudden, slip) == Approx(0.3));
      m.velocity = Vec3(-1, 0.71, 0);
      CHECK(friction(*sudden, slip) == Approx(0.3));
      m.velocity = Vec3(-1, 0.69, 0);
      CHECK(friction(*sudden, slip) == Approx(0.69));
      CHECK(sudden->response(m).status == ContactStatus::stick);
      m.velocity = Vec3(-1, 10, 0);
    }
    CHECK_FALSE(sudden->has_memory());
    m.slip = 0, m.velocity = Vec3(-1, 0.69, 0);
    CHECK(law->response(m).status == ContactStatus::stick);
    m.velocity = Vec3(-1, 10, 0);
  }
}

TEST_CASE("Stribeck friction gives the traction of its curve at the sliding speed", "[contact]") {
  ContactState m;
  m.mass = 1.2, m.dt = 1, m.area = 1;
  const double N = 0.8;
  struct Curve {
    const char *dynamic, *fixed, *speed, *viscous;
  };
  // The third curve decreases so fast that the sliding speed at the onset is not small.
  for (const Curve& at : {Curve{"0.2", "0.5", "2", "0"}, {"0.2", "0.5", "2", "0.3"}, {"0.1", "0.9", "0.05", "0.1"}}) {
    const auto law = make_law(
        "StribeckFriction", {{"coeff", at.dynamic}, {"coeffStatic", at.fixed}, {"vs", at.speed}, {"kmu", at.viscous}});
    const double mu_d = std::stod(at.dynamic), mu_s = std::stod(at.fixed), speed = std::stod(at.speed);
    const auto friction = [&](double v) {
      return mu_d + (mu_s - mu_d) * std::exp(-v / speed) + std::stod(at.viscous) * v;
    };
    int sliding = 0;
    for (const double v : {1e-6, 1e-3, 0.1, 0.5, 2.0, 30.0}) {
      // The sliding speed before friction, for which v is the speed after it
      const double before = v + friction(v) * N / m.mass;
      if (before * m.mass <= mu_s * N) continue;
      m.velocity = Vec3(-N / m.mass, 0.6 * before, -0.8 * before);
      const ContactResponse got = law->response(m);
      CHECK(got.status == ContactStatus::slip);
      CHECK(got.impulse[0] == Approx(-N).epsilon(1e-14));
      CHECK(got.impulse[1] == Approx(0.6 * friction(v) * N).epsilon(1e-12));
      CHECK(got.impulse[2] == Approx(-0.8 * friction(v) * N).epsilon(1e-12));
      ++sliding;
    }
    CHECK(sliding >= 3);
    m.velocity = Vec3(-N / m.mass, 0.999999 * mu_s * N / m.mass, 0);
    CHECK(law->response(m).status == ContactStatus::stick);
    CHECK((law->response(m).impulse - m.mass * m.velocity).norm() < 1e-15);
    m.velocity[1] *= 1.000002;
    CHECK(law->response(m).status == ContactStatus::slip);
    m.velocity = Vec3(0.1, 1, 0);
    CHECK(law->response(m).status == ContactStatus::open);
    CHECK(law->response(m).impulse.norm() == 0.0);
    CHECK_FALSE(law->has_memory());
  }
}

TEST_CASE("Stribeck friction without decrease is Coulomb friction, and overlapping faces under tension slide freely",
          "[contact]") {
  std::mt19937 random(7);
  const auto stribeck = make_law("StribeckFriction", {{"coeff", "0.4"}, {"coeffStatic", "0.4"}, {"vs", "1"}});
  const auto coulomb = make_law("CoulombFriction", {{"coeff", "0.4"}});
  for (int n = 0; n < 500; ++n) {
    const ContactState m = random_meeting(random);
    const ContactResponse a = stribeck->response(m), b = coulomb->response(m);
    CHECK(a.status == b.status);
    CHECK((a.impulse - b.impulse).norm() < 1e-14);
  }
  const auto held =
      make_law("StribeckFriction", {{"coeff", "0.4"}, {"coeffStatic", "0.5"}, {"vs", "1"}, {"displacementOnly", "1"}});
  ContactState m;
  m.gap = -0.1, m.velocity = Vec3(1, 2, 0);
  m.mass = 2, m.dt = 1, m.area = 1;
  check_impulse(held->response(m), 2, 0);
}

TEST_CASE("the onset of Stribeck sliding jumps only if friction decreases faster than the inertia of a step",
          "[contact]") {
  const auto law = make_law("StribeckFriction", {{"coeff", "0.2"}, {"coeffStatic", "0.6"}, {"vs", "0.1"}});
  const auto speed_at_onset = [&](double N) {
    ContactState m;
    m.mass = 1, m.dt = 1, m.area = 1;
    m.velocity = Vec3(-N, 0.6 * N * (1 + 1e-9), 0);
    return m.velocity[1] - law->response(m).impulse[1];
  };
  // N (mu_s - mu_d)/(v_s m) = 0.96 and 2: the root of 2 (1 - exp(-x)) = x is 1.5936242600400401
  CHECK(speed_at_onset(0.24) < 1e-7);
  CHECK(speed_at_onset(0.5) == Approx(0.15936242600400401).epsilon(1e-6));
}

TEST_CASE("Stribeck friction refuses a static coefficient below the dynamic one", "[contact]") {
  using Catch::Matchers::Contains;
  REQUIRE_THROWS_WITH(make_law("StribeckFriction", {{"coeff", "0.5"}, {"coeffStatic", "0.4"}, {"vs", "1"}}),
                      Contains("must not be less than <coeff>"));
  REQUIRE_THROWS_WITH(make_law("StribeckFriction", {{"coeff", "0.5"}, {"coeffStatic", "0.6"}}), Contains("vs"));
  REQUIRE_THROWS_WITH(make_law("StribeckFriction", {{"coeff", "0.5"}, {"coeffStatic", "0.6"}, {"vs", "0"}}),
                      Contains("vs"));
}

TEST_CASE("faces stick where friction falls with speed faster than the inertia of a step allows", "[contact]") {
  ContactState m;
  m.mass = 2, m.dt = 1, m.area = 1;
  const auto at = [&](const char* slope, double speed) {
    m.velocity = Vec3(-1, 0, -speed);  // N = 2, so that 1 + k N/m = 1 + k
    return make_law("63", {{"coeff", "0.3"}, {"kmu", slope}})->response(m);
  };
  // S = (0.3 - 0.5 v) N with v = 0.4 - S/m: S = 0.4, v = 0.2
  const auto slides = at("-0.5", 0.4);
  CHECK(slides.status == ContactStatus::slip);
  CHECK(slides.impulse[2] == Approx(-0.4).epsilon(1e-13));
  for (const char* slope : {"-1", "-3"})
    for (const double speed : {0.4, 10.0}) {
      const auto sticks = at(slope, speed);
      CHECK(sticks.status == ContactStatus::stick);
      CHECK(sticks.impulse[2] == Approx(-2 * speed).epsilon(1e-13));
    }
}

TEST_CASE("a bond needs both a shear and a tensile strength", "[contact]") {
  const LawProperties both{{"Sa", "2"}, {"Na", "1"}}, shear{{"Sa", "2"}}, tensile{{"Na", "1"}};
  for (const auto& strengths : {both, shear, tensile}) {
    const bool bonds = strengths.size() == 2;
    const auto law = make_law("63", strengths);
    ContactState m;
    m.mass = 1, m.dt = 1, m.area = 1;
    m.gap = 1e-6, m.velocity = Vec3(0.1, 0.1, 0), m.bond = Bond::whole;
    CHECK(law->response(m).impulse.norm() == Approx(bonds ? m.velocity.norm() : 0.0));
    CHECK((law->response(m).status == ContactStatus::open) == !bonds);
    m.gap = 0, m.velocity = Vec3(-0.1, 0, 0), m.bond = Bond::none;
    CHECK((law->response(m).bond == Bond::whole) == bonds);
    CHECK(law->has_memory() == bonds);
  }
}

TEST_CASE("bonds hold inside their envelope and break for good", "[contact]") {
  const auto law = make_law("63", {{"coeff", "0.3"}, {"Sa", "2"}, {"Na", "1"}});
  const auto forever = make_law("63", {{"coeff", "0.3"}, {"Sa", "2"}, {"Na", "1"}, {"rebond", "1"}});
  ContactState m;
  m.mass = 1, m.dt = 1, m.area = 1, m.gap = 1e-6, m.bond = Bond::whole;
  // failure of |T| under angles from the normal, in steps of 15 degrees: (T cos/Na)^2 + (T sin/Sa)^2 = 1
  const double strength[] = {1, 1.02610823, 1.10940039, 1.26491106, 1.51185789, 1.82501056, 2};
  for (int k = 0; k < 7; ++k) {
    const double angle = k * std::acos(-1.0) / 12;
    for (const double share : {0.9999, 1.0001}) {
      m.velocity = share * strength[k] * Vec3(std::cos(angle), std::sin(angle), 0);
      const auto got = law->response(m);
      CHECK((got.bond == Bond::whole) == (share < 1));
      CHECK(got.impulse.norm() == Approx(share < 1 ? m.velocity.norm() : 0.0));
    }
  }
  m.velocity = Vec3(0.1, 0, 0);
  m.bond = Bond::broken;
  CHECK(law->response(m).impulse.norm() == 0.0);
  m.bond = Bond::none;
  CHECK(law->response(m).impulse.norm() == 0.0);
  m.gap = 0, m.velocity = Vec3(-0.1, 0, 0);
  CHECK(law->response(m).bond == Bond::whole);  // faces that never touched bond when they do
  m.bond = Bond::broken;
  CHECK(law->response(m).bond == Bond::broken);
  CHECK(forever->response(m).bond == Bond::whole);
  // compression |N| = 1 with friction: slides at Sa + 0.3 N = 2.3
  m.bond = Bond::whole;
  for (const double slide : {2.2999, 2.3001}) {
    m.velocity = Vec3(-1, slide, 0);
    CHECK((law->response(m).status == ContactStatus::stick) == (slide < 2.3));
  }
}

TEST_CASE("slip of a liquid of any viscosity solves its equation; k = 0 is free, large k sticks", "[contact]") {
  const ContactState m = plain_meeting();
  const auto thinning = [](double rate) { return 50.0 / (1 + 0.3 * rate) + 1.0; };
  for (const char* k : {"1e-3", "1", "1e3", "1e6"}) {
    auto law = make_law("64", {{"coeff", k}, {"LiquidPhase", "1"}});
    law->set_viscosity(thinning);
    const Vec3 J = law->response(m).impulse;
    const Vec3 t(-0.6, 0.8, 0);
    const double slip = (m.velocity - J / m.mass).dot(t), rate = std::stod(k) * slip;
    CHECK(J.dot(t) == Approx(rate * thinning(rate) * m.area * m.dt).epsilon(1e-11));
  }
  auto free = make_law("64", {{"coeff", "0"}, {"LiquidPhase", "1"}}),
       sticky = make_law("64", {{"coeff", "1e15"}, {"LiquidPhase", "1"}});
  for (auto* law : {free.get(), sticky.get()}) law->set_viscosity([](double) { return 1.0; });
  check_impulse(free->response(m), -0.8448, -0.6336);
  check_impulse(sticky->response(m), -2.4, 1.44, 1e-10);
}

TEST_CASE("the slip length of a liquid is half a unit of length if it is not given", "[contact]") {
  const ContactState m = plain_meeting();
  const auto law = make_law("64", {{"LiquidPhase", "1"}});
  law->set_viscosity([](double rate) { return 500 + 10 * rate; });
  const Vec3 J = law->response(m).impulse, t(-0.6, 0.8, 0);
  const double slip = (m.velocity - J / m.mass).dot(t);
  CHECK(slip > 0);
  CHECK(J.dot(t) == Approx(2 * slip * (500 + 10 * 2 * slip) * m.area * m.dt).epsilon(1e-11));
}

TEST_CASE("laws that need closed faces give no impulse to faces that do not meet within the step", "[contact]") {
  std::vector<std::unique_ptr<ContactLaw>> laws;
  laws.push_back(make_law("61", {{"coeff", "0.4"}, {"coeffStatic", "0.6"}}));
  laws.push_back(make_law("61", {{"coeff", "-1"}, {"displacementOnly", "1"}}));
  laws.push_back(make_law("61", {{"coeff", "0.2"}, {"Dc", "100"}}));
  laws.push_back(make_law("63", {{"coeff", "0.2"}, {"Sa", "3"}}));
  laws.push_back(make_law("StribeckFriction", {{"coeff", "0.2"}, {"coeffStatic", "0.5"}, {"vs", "4"}}));
  std::mt19937 random(3);
  for (const auto& law : laws) {
    REQUIRE(law->needs_closed_faces());
    for (int n = 0; n < 2000; ++n) {
      ContactState m = random_meeting(random);
      m.gap = 1e-6 + std::max(std::abs(m.gap), -m.dt * m.velocity.dot(m.normal));
      REQUIRE(law->response(m).impulse.isZero(0));
      REQUIRE(law->response(m).status == ContactStatus::open);
    }
  }
  CHECK_FALSE(make_law("63", {{"coeff", "0.2"}, {"Sa", "30"}, {"Na", "20"}})->needs_closed_faces());
  CHECK_FALSE(make_law("64", {{"coeff", "5"}, {"LiquidPhase", "1"}})->needs_closed_faces());
}

TEST_CASE("frictional laws dissipate, mirror, and are continuous in the velocity", "[contact]") {
  std::mt19937 random(1);
  std::vector<std::unique_ptr<ContactLaw>> laws;
  laws.push_back(make_law("61", {{"coeff", "0.4"}}));
  laws.push_back(make_law("61", {{"coeff", "-1"}}));
  laws.push_back(make_law("63", {{"coeff", "0.2"}, {"Sa", "3"}, {"kmu", "0.3"}}));
  laws.push_back(make_law("63", {{"coeff", "0.2"}, {"coeffStatic", "0.5"}, {"vhalf", "2"}, {"kmu", "0.1"}}));
  laws.push_back(make_law("StribeckFriction", {{"coeff", "0.2"}, {"coeffStatic", "0.5"}, {"vs", "4"}, {"kmu", "0.1"}}));
  laws.push_back(make_law("64", {{"coeff", "5"}, {"LiquidPhase", "1"}}));
  laws.back()->set_viscosity([](double rate) { return 1 + 1 / (1 + rate); });
  const std::size_t continuous = laws.size();
  laws.push_back(make_law("StribeckFriction", {{"coeff", "0.1"}, {"coeffStatic", "0.9"}, {"vs", "0.01"}}));
  laws.push_back(make_law("61", {{"coeff", "0.2"}, {"coeffStatic", "0.6"}}));
  laws.push_back(make_law("63", {{"coeff", "0.2"}, {"Sa", "30"}, {"Na", "20"}}));
  for (std::size_t k = 0; k < laws.size(); ++k)
    for (int n = 0; n < 2000; ++n) {
      const ContactState m = random_meeting(random);
      const ContactResponse a = laws[k]->response(m), b = laws[k]->response(mirrored(m));
      REQUIRE((a.impulse + b.impulse).norm() <= 1e-14 * (1 + a.impulse.norm()));
      REQUIRE(energy_change(m, a.impulse) <= 1e-14);
      if (k >= continuous) continue;
      ContactState near = m;
      near.velocity += Vec3(1e-9, -2e-9, 1e-9);
      REQUIRE((laws[k]->response(near).impulse - a.impulse).norm() < 1e-7);
    }
}
