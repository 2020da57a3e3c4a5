// SPDX-License-Identifier: MIT
/// The feedback of LoadControl on a spring.

#include "solver/state/load_controller.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

LoadControl control_of(const std::string& load) {
  LoadControl out;
  out.material = 0, out.load = Expression(load, Origin{});
  out.start = 0.5, out.fastest = 20, out.Kp = 10, out.Ki = 25;
  return out;
}

/// Moves the far end of a spring of stiffness 7; returns the controller and the load at the end.
std::pair<LoadController, double> pull_spring(const LoadControl& control, double end, double stiffness = 7) {
  LoadController c;
  c.velocity = control.start;
  constexpr double dt = 1e-3;
  double x = 0;
  for (int k = 1; k * dt < end; ++k) {
    x += dt * c.velocity;
    c.update(stiffness * x, k * dt, dt, control);
  }
  return {c, stiffness * x};
}

}  // namespace

TEST_CASE("LoadControl reaches a load, positive or negative, and follows a ramp", "[load]") {
  CHECK(pull_spring(control_of("3"), 3).second == Approx(3).epsilon(1e-4));
  LoadControl push = control_of("-3");
  push.start = -0.5;
  CHECK(pull_spring(push, 3).second == Approx(-3).epsilon(1e-4));
  CHECK(pull_spring(control_of("2*t"), 3).second == Approx(6).epsilon(2e-3));
  const auto [c, load] = pull_spring(control_of("3"), 3);
  CHECK(c.stiffness == Approx(7).epsilon(1e-9));
  CHECK(std::abs(c.velocity) < 1e-3);
}

TEST_CASE("LoadControl keeps its largest speed and does not overshoot after it", "[load]") {
  LoadControl control = control_of("70");  // 10 away, at a speed of 2
  control.fastest = 2;
  LoadController c;
  c.velocity = control.start;
  double x = 0, most = 0;
  for (int k = 1; k < 12000; ++k) {
    x += 1e-3 * c.velocity;
    c.update(7 * x, 1e-3 * k, 1e-3, control);
    CHECK(std::abs(c.velocity) <= 2);
    most = std::max(most, 7 * x);
  }
  CHECK(7 * x == Approx(70).epsilon(1e-3));
  CHECK(most < 70 * 1.03);
}

TEST_CASE("LoadControl keeps its velocity until a load is felt", "[load]") {
  const LoadControl control = control_of("3");
  LoadController c;
  c.velocity = control.start;
  for (int k = 1; k < 10; ++k) c.update(0, 1e-3 * k, 1e-3, control);
  CHECK(c.velocity == 0.5);
  CHECK(c.stiffness == 0);
  c.update(-1, 0.01, 1e-3, control);  // a load against the motion has no meaning as a stiffness
  CHECK(c.velocity == 0.5);
}
