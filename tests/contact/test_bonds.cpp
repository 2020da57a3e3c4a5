// SPDX-License-Identifier: MIT
/// Areas, units, methods, friction and events of SpringNetwork.

#include "contact/bond_cases.hpp"

using namespace tribo;
using namespace tribo::test;
using namespace tribo::test::bonds;

TEST_CASE("rotational stiffnesses are moments per angle, in legacy units in N mm", "[spring_network]") {
  const Units legacy{true, "mm", "g", "s"};
  Contact c("SpringNetwork", {{"kn", "1"}, {"krot", "2 3 4"}}, face(), legacy);
  CHECK(c.joint.twist_stiffness == near(2e6));  // g mm^2/s^2
  CHECK(c.joint.bend_stiffness[0] == near(3e6));
  CHECK(c.joint.bend_stiffness[1] == near(4e6));
}

TEST_CASE("sn_rmul scales the radius of a ball, and with it its area and moments", "[spring_network]") {
  constexpr double pi = std::numbers::pi;
  JointSite ball;
  ball.radius = 1, ball.thickness = 1;
  for (const bool plane : {true, false}) {
    INFO((plane ? "disc" : "ball"));
    ball.plane = plane, ball.area = plane ? 2 : pi;
    const Joint one = Contact("SpringNetwork", {{"kn", "3"}, {"ks", "5"}}, ball).joint,
                two = Contact("SpringNetwork", {{"kn", "3"}, {"ks", "5"}, {"sn_rmul", "2"}}, ball).joint;
    CHECK(one.area == near(plane ? 2 : pi));
    CHECK(two.area == near(plane ? 4 : 4 * pi));
    CHECK(two.radius == 2);
    CHECK(two.inertia == near(plane ? 16.0 / 3 : 4 * pi));
    CHECK(two.polar == near(plane ? 0 : 8 * pi));
    CHECK(two.bend_stiffness[0] == near(3 * two.inertia));
    // a given area is not scaled
    CHECK(Contact("SpringNetwork", {{"kn", "3"}, {"user_area", "7"}, {"sn_rmul", "2"}}, ball).joint.area == 7);
  }
  JointSite wall = face();  // faces have no radius
  CHECK(Contact("SpringNetwork", {{"kn", "3"}, {"sn_rmul", "2"}}, wall).joint.area == near(A));
}

TEST_CASE("kn and ks resist rotation with the moments of the contact area", "[spring_network]") {
  const Properties springs{{"kn", "5e12"}, {"ks", "3e12"}, {"bond", ""}};
  Contact c("SpringNetwork", springs + strong, face());
  c.move(0, {}, 1e-5, {1e-5, -2e-5});
  const double I_face = A * A / 12;
  CHECK(c.joint.Mt == near(-3e12 * 2 * I_face * 1e-5));
  CHECK(c.joint.Mb.s == near(-5e12 * I_face * 1e-5));
  CHECK(c.joint.Mb.t == near(5e12 * I_face * 2e-5));
  // the same as compute-stiffness with kn = ks = E/d, and the energy of the published sum
  Contact same("SpringNetwork", Properties{{"kn", "5e12"}, {"ks", "5e12"}, {"bond", ""}} + strong, face());
  CHECK(same.joint.twist_stiffness == near(k_twist));
  CHECK(same.joint.bend_stiffness[0] == near(k_bend));
  CHECK(c.joint.strain == near(0.5 * (c.joint.Mt * c.joint.Mt / (3e12 * 2 * I_face) +
                                      (c.joint.Mb.s * c.joint.Mb.s + c.joint.Mb.t * c.joint.Mb.t) / (5e12 * I_face))));
  // in two dimensions about s only
  JointSite edge;
  edge.area = 0.02;
  Contact flat("SpringNetwork", springs + strong, edge);
  flat.move(0, {}, 0, {1e-5, 0});
  CHECK(flat.joint.Mb.s == near(-5e12 * 2.0 / 3 * 1e-6 * 1e-5));
  CHECK(flat.joint.twist_stiffness == 0);
  // none with krot 0, with assign-stiffness, or if several contacts share the face
  CHECK(Contact("SpringNetwork", springs + Properties{{"krot", "0 0 0"}}, face()).joint.twist_stiffness == 0);
  CHECK(Contact("SpringNetwork", {{"assign-stiffness", "kn 2e9 kratio 4"}}, face()).joint.bend_stiffness[0] == 0);
  JointSite corner = face();
  corner.part_of_face = true;
  CHECK(Contact("SpringNetwork", springs, corner).joint.bend_stiffness[0] == 0);
}

TEST_CASE("a contact that is unbonded at the start presses by its overlap", "[spring_network]") {
  JointSite overlapping = face();
  overlapping.gap = -2e-6;
  const Properties springs{{"kn", "5e12"}, {"ks", "5e12"}};
  Contact plain("SpringNetwork", springs, overlapping),
      released("SpringNetwork", springs + Properties{{"unbond", ""}}, overlapping);
  CHECK(plain.move(0).joint.Fn == near(-1000));
  CHECK(released.move(0).joint.Fn == near(-1000));
  CHECK(released.move(1e-6).joint.Fn == near(-500));
  // a given force belongs to the gap at the start
  Contact pressed("SpringNetwork", springs + Properties{{"sn_force", "300 0 0"}, {"unbond", ""}}, overlapping);
  CHECK(pressed.move(0).joint.Fn == near(-300));
  CHECK(pressed.move(-1e-7).joint.Fn == near(-350));
}

TEST_CASE("the friction coefficient without bond is tan(sn_fa) if it is not given", "[spring_network]") {
  const auto slides_at = [](const Properties& more) {
    Contact c("SpringNetwork", Properties{{"kn", "5e12"}, {"ks", "5e12"}} + more, face());
    return c.move(-2e-6).shear(1e-3).joint.Fs.norm();
  };
  CHECK(slides_at({}) == 0);
  CHECK(slides_at({{"sn_fa", "30"}}) == near(1000 / std::sqrt(3.0)));
  CHECK(slides_at({{"sn_fa", "30"}, {"fric", "0"}}) == 0);
  CHECK(slides_at({{"sn_fa", "30"}, {"fric", "0.4"}}) == near(400));
}

TEST_CASE("sn_cohtab multiplies the excess of the peak over the residual strength", "[spring_network]") {
  // tau_c A = 1577.35, residual 577.35 + 200: at the multiplier 0.25 a quarter of the difference is left
  auto c = bond(rock + Properties{{"sn_cohtab", "1 0, 0.25 4e-6, 0 1e-5"}, {"sn_cohres", "2e6"}});
  c.move(-2e-6);
  slide_to_break(c);
  c.slide(16, 2.5e-7);
  const double residual = 577.3502691896257 + 200, peak = 1577.3502691896256;
  CHECK(c.joint.Fs.norm() == near(residual + 0.25 * (peak - residual)));
  c.slide(40, 2.5e-7);
  CHECK(c.joint.Fs.norm() == near(residual));
}

TEST_CASE("the event of a broken bond has the strength and the force of its step", "[spring_network]") {
  auto torn = bond(brittle);
  torn.move(0.999e-6).move(0.002e-6);
  CHECK(last_break(torn).strength == near(5e6));
  CHECK(last_break(torn).force == near(kA * 1.001e-6));
  auto sheared = bond(rock);
  sheared.move(-1e-6).move(-1e-6, {4e-6, 0});  // F_n = -1000 in the failing step, -500 before
  CHECK(last_break(sheared).mode == 2);
  CHECK(last_break(sheared).strength == near(15773502.691896256));
  CHECK(last_break(sheared).force == near(kA * 4e-6));
  auto softened = bond(soft);
  softened.move(3e-6).move(3e-6);  // half of the strength is left after the first step
  CHECK(last_break(softened).strength == near(2.5e6));
  auto healed = bond(rock + Properties{{"sn_heal", "1"}});
  healed.move(-2e-6);
  slide_to_break(healed);
  healed.shear(1e-7).shear(-1e-9);
  REQUIRE(healed.joint.state == 6);
  const int before = healed.count(JointEvent::Kind::bond_break);
  healed.move(2.1e-6);
  CHECK(healed.count(JointEvent::Kind::bond_break) == before + 1);
  CHECK(last_break(healed).strength == 0);
}

TEST_CASE("areas may be given to each contact of a surface", "[spring_network][mohr]") {
  for (const char* type : {"SpringNetwork", "Mohr"}) {
    JointSite site = face();
    const Properties list{{"user_area", "3, 4 5"}};
    CHECK(Contact(type, list, site).joint.area == 3);
    site.number = 2;
    CHECK(Contact(type, list, site).joint.area == 5);
    CHECK(Contact(type, {{"user_area", "7"}}, site).joint.area == 7);
    CHECK(Contact(type, {{"area", ""}}, site).joint.area == near(A));
    CHECK(Contact(type, {{"area", "7"}}, site).joint.area == 7);
    CHECK(Contact(type, {{"user_area", "7"}, {"area", ""}}, site).joint.area == 7);
    CHECK(complaints(type, {{"user_area", "7"}, {"area", "8"}}).find("the area again") != std::string::npos);
    CHECK(complaints(type, {{"user_area", "7 0"}}).find("must be positive") != std::string::npos);
    CHECK(complaints(type, {{"user_area", "-7"}}).find("must be >= 0") != std::string::npos);
    CHECK(complaints(type, {{"user_area", ""}}).find("needs an area") != std::string::npos);
  }
}

TEST_CASE("a contact without area has no stress, but the results are numbers", "[spring_network][mohr]") {
  for (const char* type : {"SpringNetwork", "Mohr"}) {
    Contact left(type, {}, face());
    left.joint.area = 0;
    for (const char* name : {"sn_sigma", "sn_esigma", "sn_tau", "sn_shear", "stress_effective"})
      if (std::string_view(type) == "Mohr" ? std::string_view(name) == "stress_effective"
                                           : std::string_view(name) != "stress_effective")
        CHECK(left.own(name) == 0);
  }
}
