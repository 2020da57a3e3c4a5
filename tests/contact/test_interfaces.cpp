// SPDX-License-Identifier: MIT
#include "contact/contact_cases.hpp"
#include "contact/interface.hpp"
#include "contact/interface_joint.hpp"
#include "contact/spring_step.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

// Oscillator under a constant force.
double exact_opening(double mass, double k, double f, double d0, double v0, double t) {
  const double w = std::sqrt(k / mass);
  return d0 * std::cos(w * t) + v0 * std::sin(w * t) / w + f / k * (1 - std::cos(w * t));
}

}  // namespace

TEST_CASE("the steps of a spring run through the openings of the exact oscillation", "[contact]") {
  const double exact[] = {6.214436e-4, 5.896718e-4, 2.946413e-4, -9.666019e-4};
  const double stiffness[] = {1e2, 1e3, 1e4, 1e6};
  for (int n = 0; n < 4; ++n) {
    const double k = stiffness[n];
    CHECK(exact_opening(1.2, k, 3, 1e-3, -0.05, 0.01) == Approx(exact[n]).epsilon(1e-6));
    const double dt = n < 3 ? 1e-3 : 1e-4;  // phi = 0.009 ... 0.09
    double d = 1e-3, v = (exact_opening(1.2, k, 3, 1e-3, -0.05, dt) - d) / dt;
    d += dt * v;
    for (int s = 2; s <= std::lround(0.01 / dt); ++s) {
      const double free = v + 3 * dt / 1.2;
      v = free - spring_impulse(1.2, k, d, v, free, dt) / 1.2;
      d += dt * v;
    }
    CHECK(d == Approx(exact_opening(1.2, k, 3, 1e-3, -0.05, 0.01)).epsilon(1e-10));
  }
}

TEST_CASE("a spring is stable for any stiffness and step", "[contact]") {
  for (const double phi : {0.3, 0.99, 1.5, 1.99, 2.2, 2.9, 3.1, 5.0, 100.0, 1e6}) {
    double d = 1e-3, v = -0.05;
    const double k = phi * phi * 1.2 / 1e-4;
    double most = 0;
    for (int s = 0; s < 10000; ++s) {
      v -= spring_impulse(1.2, k, d, v, v, 0.01) / 1.2;
      d += 0.01 * v;
      most = std::max(most, std::abs(d));
    }
    CHECK(most < 2.5e-3);
    if (phi > 1) CHECK(std::abs(d) < 1e-12);
  }
}

TEST_CASE("the impulse of a spring is continuous in its stiffness and joins in the limit", "[contact]") {
  const auto J = [](double phi) { return spring_impulse(1.2, 1.2 * phi * phi / 1e-4, 1e-3, -0.05, 0.02, 0.01); };
  CHECK(J(3 * (1 - 1e-9)) == Approx(J(3 * (1 + 1e-9))).epsilon(1e-7));
  // A rigid spring closes the gap within the step (backward Euler).
  CHECK(J(1e7) == Approx(1.2 * (0.02 + 1e-3 / 0.01)).epsilon(1e-5));
}

namespace {

/// An interface law of the input; `joint` makes a joint of unit area of it.
std::shared_ptr<const InterfaceLaw> interface_law(const char* number, LawProperties properties) {
  const std::shared_ptr<const ContactLaw> law = make_law(number, properties);
  return {law, law->interface()};
}

/// Moves a joint by one increment.
void move(const InterfaceJoint& law, Joint& joint, double normal, Tangent shear) {
  JointIncrement step;
  step.normal = normal, step.shear = shear;
  std::vector<JointEvent> events;
  law.update({&joint, 1}, {&step, 1}, events);
}

Joint unit_joint(const InterfaceJoint& law, double area = 1.0) {
  JointSite site;
  site.area = area;
  return law.start(site);
}

}  // namespace

TEST_CASE("the energy of an interface is that of the paths to a jump, and comes back", "[contact]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> component(-1, 1);
  const std::vector<std::shared_ptr<const InterfaceLaw>> laws{
      interface_law("62", {{"Dn", "20"}, {"Dt", "5"}}),
      interface_law("62", {{"Dnt", "20"}, {"Dnc", "200"}, {"Dt", "-1"}}),
      interface_law("65", {{"Dnt", "20"},
                           {"Dt", "5"},
                           {"normal_shape", "1"},
                           {"Npeak", "1"},
                           {"tangential_shape", "1"},
                           {"Tpeak", "1"}}),
      interface_law("65", {{"Dnt", "20"},
                           {"Dt", "5"},
                           {"normal_shape", "2"},
                           {"Npeak", "1"},
                           {"Nbreak", "0.3"},
                           {"tangential_shape", "2"},
                           {"Tpeak", "1"},
                           {"Tbreak", "0.5"}})};
  for (const auto& law : laws) {
    const InterfaceJoint joint_law(law);
    for (int path = 0; path < 20; ++path) {
      // A smooth closed path: the work on the way is the stored energy, the force is restoring.
      Joint joint = unit_joint(joint_law, 0.7);
      const double a = 0.3 * component(random), b = 0.3 * component(random), c = 0.3 * component(random);
      const int steps = 4000;
      double most = 0;
      for (int k = 0; k < steps; ++k) {
        const double s0 = 2 * M_PI * k / steps, s1 = 2 * M_PI * (k + 1) / steps;
        const auto at = [&](double s) {
          return std::array{a * std::sin(s), b * (1 - std::cos(s)), c * std::sin(2 * s)};
        };
        const auto from = at(s0), to = at(s1);
        move(joint_law, joint, to[0] - from[0], {to[1] - from[1], to[2] - from[2]});
        REQUIRE(joint.strain >= 0);
        REQUIRE(joint.Fs.dot(joint.shear) <= 0);
        most = std::max(most, joint.strain);
        REQUIRE(std::abs(joint.work - joint.strain) < 2e-3 * most + 1e-12);
      }
      REQUIRE(joint.strain < 1e-12);
    }
  }
}

TEST_CASE("perfect directions of an interface stick at the nodes, elastic ones leave them free", "[contact]") {
  const ContactState m = plain_meeting();
  CHECK((make_law("62", {})->response(m).impulse - m.mass * m.velocity).norm() < 1e-15);
  CHECK(make_law("62", {{"Dn", "3"}, {"Dt", "4"}})->response(m).impulse.isZero());
  const Vec3 normal = m.velocity.dot(m.normal) * m.normal;
  CHECK((make_law("62", {{"Dn", "-1"}, {"Dt", "4"}})->response(m).impulse - m.mass * normal).norm() < 1e-15);
  CHECK((make_law("62", {{"Dn", "3"}, {"Dt", "-1"}})->response(m).impulse - m.mass * (m.velocity - normal)).norm() <
        1e-15);
}

TEST_CASE("directions of an interface that the grid cannot resolve are bonded", "[contact]") {
  const auto limited = [](LawProperties properties) { return interface_law("62", properties)->limited(100); };
  CHECK(limited({{"Dn", "101"}, {"Dt", "99"}})->bonds_normal());
  CHECK(!limited({{"Dn", "101"}, {"Dt", "99"}})->bonds_tangential());
  CHECK(limited({{"Dn", "99"}, {"Dt", "101"}})->bonds_tangential());
  // one side of the normal direction only: it gets the largest stiffness
  const auto stop = limited({{"Dnt", "5"}, {"Dnc", "-1"}, {"Dt", "0"}});
  CHECK(!stop->bonds_normal());
  CHECK(stop->traction(-0.1, 0).normal == Approx(-10));
  CHECK(stop->traction(0.1, 0).normal == Approx(0.5));
  const auto hook = limited({{"Dnt", "1e9"}, {"Dnc", "5"}, {"Dt", "0"}});
  CHECK(hook->traction(0.1, 0).normal == Approx(10));
  // a law with a peak stays elastic, however stiff it is at first
  const auto peak =
      interface_law("65", {{"Dnt", "1e4"}, {"Dt", "1"}, {"normal_shape", "2"}, {"Npeak", "10"}, {"Nbreak", "0.1"}})
          ->limited(100);
  CHECK(peak->traction(1e-3, 0).normal == Approx(10));
  CHECK(peak->traction(-0.1, 0).normal == Approx(-10));
  const auto never_closed =
      interface_law("65", {{"Dnt", "5"}, {"Dnc", "-1"}, {"Dt", "1"}, {"normal_shape", "1"}, {"Npeak", "10"}})
          ->limited(100);
  CHECK(never_closed->traction(-0.1, 0).normal == Approx(-10));
}

TEST_CASE("Morse's law has its slope, its peak, and softens", "[contact]") {
  const auto law = interface_law("65", {{"Dnt", "400"}, {"Dt", "0"}, {"normal_shape", "1"}, {"Npeak", "10"}});
  const auto traction = [&](double d) { return law->traction(d, 0).normal; };
  CHECK(traction(1e-7) == Approx(400e-7).epsilon(1e-5));
  CHECK(traction(std::log(2.0) / 10) == Approx(10).epsilon(1e-6));
  CHECK(traction(0.2) < traction(0.1));
  CHECK(traction(-1e-3) == Approx(-0.4).epsilon(1e-6));
  CHECK(law->traction(100, 0).energy == Approx(8 * 100.0 / 400).epsilon(1e-9));  // the depth of the well
}

TEST_CASE("the bilinear shape rises, falls straight, and ends", "[contact]") {
  const auto law = interface_law("65", {{"Dnt", "400"},
                                        {"Dt", "100"},
                                        {"normal_shape", "2"},
                                        {"Npeak", "10"},
                                        {"Nbreak", "0.1"},
                                        {"tangential_shape", "2"},
                                        {"Tpeak", "4"},
                                        {"Tbreak", "0.2"}});
  const auto normal = [&](double d) { return law->traction(d, 0).normal; };
  const auto tangential = [&](double d) { return law->traction(0, d).tangential; };
  CHECK(normal(0.02) == Approx(8).epsilon(1e-9));    // 400 * 0.02
  CHECK(normal(0.025) == Approx(10).epsilon(1e-9));  // the peak
  CHECK(normal(0.0625) == Approx(5).epsilon(1e-9));  // half way down
  CHECK(normal(0.11) == 0.0);
  CHECK(normal(-0.01) == Approx(-4).epsilon(1e-9));  // closed it stays linear
  CHECK(tangential(0.03) == Approx(3).epsilon(1e-9));
  CHECK(tangential(0.12) == Approx(2).epsilon(1e-9));
  CHECK(law->traction(0.5, 0).energy == Approx(0.5 * 10 * 0.1).epsilon(1e-9));  // the triangle
}
