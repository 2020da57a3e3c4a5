// SPDX-License-Identifier: MIT
/// Walls that move through the grid.

#include "cloud.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

// A wall normal to x that starts at x = 16, where the block in cells 8 to 16 ends.
NodeCondition wall_at_end(double velocity, double depth, const char* displacement = "0") {
  NodeCondition condition;
  condition.where = rectangle(15.9, 16.1, 6, 18);
  condition.velocity.value = velocity;
  condition.wall.emplace();
  condition.wall->depth = depth;
  condition.wall->displacement = Expression(displacement, Origin{});
  return condition;
}

Vec<2> velocity_at(const System<2>& system, int i, int j) {
  const auto& field = system.fields[0];
  const auto node = field.map.node({i + Lattice<2>::padding, j + Lattice<2>::padding});
  REQUIRE(node >= 0);
  const Node& n = field.nodes[static_cast<std::size_t>(node)];
  return {n.velocity[0], n.velocity[1]};
}

std::string problem_of(const Model& model) {
  try {
    auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
    Stepper<2> stepper(model, system);
    stepper.advance(1e-3);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("a moving wall sets the velocity on the nodes within its depth and beyond it", "[walls]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip);
  model.node_conditions.push_back(wall_at_end(-0.5, 1, "-1.3"));  // at 14.7
  model.node_conditions[0].wall->gradient = Expression("2*x", Origin{});
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
  Stepper<2> stepper(model, system);
  stepper.advance(1e-3);
  for (int i = 14; i <= 17; ++i) {
    INFO("node " << i);
    CHECK(velocity_at(system, i, 12)[0] == Approx(-0.5 + 2 * 14.7 * (i - 14.7)));
    CHECK(velocity_at(system, i, 12)[1] == Approx(0).margin(1e-12));
  }
  CHECK(velocity_at(system, 13, 12)[0] == Approx(0).margin(1e-12));
}

TEST_CASE("a moving wall that mirrors continues the velocity of the nodes inside", "[walls]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip);
  model.node_conditions.push_back(wall_at_end(0.3, 1));
  model.node_conditions[0].where = rectangle(12.9, 13.1, 6, 18);  // inside, where the field is linear
  model.node_conditions[0].wall->mirror = true;
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
  const Vec<2> slope(0.02, 0);
  set_velocity<2>(system.bodies[0], [&](const Vec<2>& x) -> Vec<2> { return {0.3 + slope[0] * (x[0] - 13), 0}; });
  Stepper<2> stepper(model, system);
  stepper.advance(1e-9);
  for (const int i : {12, 13, 14, 15})
    CHECK(velocity_at(system, i, 12)[0] == Approx(0.3 + slope[0] * (i - 13)).epsilon(1e-6));
}

TEST_CASE("work and impulse of a moving wall are those of the material, in every order of updates", "[walls]") {
  const auto order = GENERATE(UpdateOrder::usf, UpdateOrder::usl, UpdateOrder::usavg);
  const bool again = order != UpdateOrder::usf && GENERATE(false, true);
  const double side = GENERATE(1.0, -1.0);
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip, order, again);
  NodeCondition wall = wall_at_end(-0.5 * side, 1, side > 0 ? "-0.5*t" : "0.5*t");
  if (side < 0) wall.where = rectangle(7.9, 8.1, 6, 18), wall.wall->side = -1;
  model.node_conditions.push_back(wall);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 400; ++k) {
    const Vec3 before = measure(system).momentum;
    const double dt = 5e-3;
    const Vec3 impulse = stepper.conditions(0).impulse();
    stepper.advance(dt);
    const Vec3 gained = measure(system).momentum - before, given = stepper.conditions(0).impulse() - impulse;
    CHECK((gained - given).norm() < 1e-9 * (1 + given.norm()));
    CHECK((dt * stepper.conditions(0).reactions()[0] - given).norm() < 1e-9 * (1 + given.norm()));
  }
  CHECK(side * measure(system).momentum[0] < 0);
  CHECK(stepper.conditions(0).work() > measure(system).kinetic);
}

TEST_CASE("moving walls that cannot be are reported", "[walls]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip);
  model.node_conditions.push_back(wall_at_end(0, 1));
  model.node_conditions[0].where = rectangle(14.9, 16.1, 6, 18);
  CHECK_THAT(problem_of(model), Catch::Contains("starts in 2 planes of nodes"));
  model.node_conditions[0].where = rectangle(14.3, 14.6, 6, 18);
  CHECK_THAT(problem_of(model), Catch::Contains("starts at no node"));
  model.node_conditions[0] = wall_at_end(0, 1, "9");
  CHECK_THAT(problem_of(model), Catch::Contains("the moving wall has left the grid at 25"));
}
