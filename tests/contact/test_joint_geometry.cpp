// SPDX-License-Identifier: MIT
#include "contact/joint_cases.hpp"
#include "contact/joint_geometry.hpp"

#include <numbers>

using namespace tribo;
using namespace tribo::test;

TEST_CASE("TS1: moments of polygons, discs and strips", "[joint_geometry]") {
  std::vector<Tangent> rectangle{{10, -7}, {12, -7}, {12, -4}, {10, -4}};
  for (int turn = 0; turn < 2; ++turn) {
    const auto m = polygon_moments(rectangle);
    CHECK(m.area == near(6));
    CHECK(m.I_s == near(4.5));
    CHECK(m.I_t == near(2));
    CHECK(std::abs(m.I_st) < 1e-12);
    CHECK(m.centroid.s == near(11));
    CHECK(m.centroid.t == near(-5.5));
    std::reverse(rectangle.begin(), rectangle.end());
  }
  const std::vector<Tangent> triangle{{0, 0}, {3, 0}, {0, 2}};
  const auto m = polygon_moments(triangle);
  CHECK(m.area == near(3));
  CHECK(m.I_s == near(2.0 / 3));
  CHECK(m.I_t == near(1.5));
  CHECK(m.I_st == near(-0.5));

  JointSite ball;
  ball.plane = false, ball.radius = 0.005, ball.area = std::numbers::pi * 25e-6, ball.distance = 1;
  const Contact c("SpringNetwork", {{"compute-stiffness", "emod 1"}}, ball);
  CHECK(c.joint.radius == near(0.005));
  CHECK(c.joint.inertia == near(4.908738521234052e-10));
  CHECK(c.joint.polar == near(9.817477042468103e-10));
  JointSite disc;
  disc.radius = 0.005, disc.area = 0.01;
  const Contact plane("SpringNetwork", {}, disc);
  CHECK(plane.joint.inertia == near(8.333333333333335e-08));
  JointSite face;
  face.area = 1e-4, face.distance = 0.01, face.plane = false, face.has_moments = true;
  face.moments = {1e-8 / 12, 1e-8 / 12, 0};
  const Contact square("SpringNetwork", {{"compute-stiffness", "emod 50e9"}}, face);
  CHECK(square.joint.twist_stiffness == near(8333.333333333334));
  CHECK(square.joint.bend_stiffness[0] == near(4166.666666666667));
}

TEST_CASE("TS15: force of the fictitious stress", "[joint_geometry]") {
  Mat3 one = Vec3(1, -2, 0.5).asDiagonal(), two = Vec3(2, -4, 1).asDiagonal();
  one(0, 1) = one(1, 0) = 0.3;
  const Mat3 mean = 1e6 * (2 * one + 1 * two) / 3;
  JointAxes axes{{0.6, 0.8, 0}, {0.8, -0.6, 0}, {0, 0, -1}};
  const auto plain = poisson_force(mean, 0.25, 0, 1e-4, axes);
  CHECK(plain.normal == near(14));
  CHECK(plain.shear.s == near(48));
  CHECK(std::abs(plain.shear.t) < 1e-12);
  const auto whole = poisson_force(mean, 0.25, 1, 1e-4, axes);
  CHECK(whole.normal == near(9.2));
  CHECK(whole.shear.s == near(49.4));
}

TEST_CASE("TM20: axes that follow a normal around an oblique cone return to their initial directions",
          "[joint_geometry]") {
  const Vec3 axis = Vec3(1, 2, 3).normalized(), from = Vec3(0.3, -0.5, 0.8).normalized();
  JointAxes axes = JointAxes::of_normal(from), start = axes;
  const int steps = 720;
  const double turn = 2 * std::numbers::pi / steps;
  for (int k = 1; k <= steps; ++k) {
    const Vec3 n = Eigen::AngleAxisd(k * turn, axis) * from;
    axes.follow(n, turn * axis.dot((axes.n + n).normalized()));
  }
  CHECK((axes.s - start.s).norm() < 1e-4);
  CHECK((axes.t - start.t).norm() < 1e-4);
  CHECK(std::abs(axes.n.cross(axes.s).dot(axes.t) - 1) < 1e-12);
}

TEST_CASE("in two dimensions the tangent is t = (n_y, -n_x)", "[joint_geometry]") {
  const auto axes = JointAxes::of_normal(Vec3(3, 4, 0));
  CHECK((axes.s - Vec3::UnitZ()).norm() == 0);
  CHECK((axes.t - Vec3(0.8, -0.6, 0)).norm() < 1e-15);
}
