// SPDX-License-Identifier: MIT
/// Histories of single particles.

#include "../solver/cloud.hpp"
#include "contact/contact_cases.hpp"

#include "base/error.hpp"
#include "run/tracers.hpp"

using namespace tribo;
using namespace tribo::test;
using Catch::Contains;

namespace {

HistoryQuantity of_point(double x, double y, int material = -1) {
  HistoryQuantity q;
  q.name = q.column = "dispx";
  q.point = Vec3(x, y, 0);
  q.material = material;
  return q;
}

}  // namespace

TEST_CASE("a tracer is the particle that started nearest and is followed wherever it goes", "[tracers]") {
  Model model = grid_model<2>(Kernel::gimp, Transfer::flip);
  model.output.history = {of_point(10.3, 9.7), of_point(13.8, 13.9)};
  auto seeds = lattice_seeds<2>(model, 8, 14);
  auto system = build_system<2>(model, seeds);
  const Tracers<2> tracers(model, system);
  Stepper<2> stepper(model, system);
  // A solid that flies: particles change cells, and with them their places in memory.
  const Vec3 velocity(3, -2, 0);
  set_velocity<2>(system.bodies[0], [&](const Vec<2>&) -> Vec<2> { return velocity.head<2>(); });
  for (int step = 0; step < 1000; ++step) stepper.advance(1e-3);
  const Measures first = tracers.measure(system, 0, false), second = tracers.measure(system, 1, false);
  CHECK((first.centre - Vec3(13.25, 7.75, 0)).norm() < 1e-9);
  CHECK((second.centre - Vec3(16.75, 11.75, 0)).norm() < 1e-9);
  CHECK((first.displacement - velocity).norm() < 1e-9);
  CHECK(first.particles == 1);
  CHECK(first.mass == Approx(250));
}

TEST_CASE("a tracer is of the material asked for, and equally near particles leave it to the lowest id", "[tracers]") {
  Model model = grid_model<2>(Kernel::gimp, Transfer::flip);
  model.materials.push_back(model.materials[0]);
  auto seeds = lattice_seeds<2>(model, 8, 10);
  auto right = lattice_seeds<2>(model, 8, 10);
  for (auto& s : right) s.x[0] += 2, s.material = 1;
  seeds.insert(seeds.end(), right.begin(), right.end());
  auto system = build_system<2>(model, seeds);
  const auto start = [&](const HistoryQuantity& q) -> Vec3 {
    model.output.history = {q};
    return Tracers<2>(model, system).measure(system, 0, false).centre;
  };
  CHECK(start(of_point(9.7, 8.3)) == Vec3(9.75, 8.25, 0));
  CHECK(start(of_point(9.7, 8.3, 1)) == Vec3(10.25, 8.25, 0));
  CHECK(start(of_point(9, 9)) == Vec3(8.75, 8.75, 0));
  CHECK_THROWS_WITH(start(of_point(14, 9)), Contains("no particle starts within a cell"));
}

TEST_CASE("a tracer may be a particle of a rigid body, where there is no deformable one", "[tracers]") {
  Model model = grid_model<2>(Kernel::gimp, Transfer::flip);
  add_rigid_tool(model, "0", "-2");
  auto seeds = lattice_seeds<2>(model, 8, 10);
  auto above = lattice_seeds<2>(model, 8, 10);
  for (auto& s : above) s.x[1] += 8, s.material = 1;
  seeds.insert(seeds.end(), above.begin(), above.end());
  auto system = build_system<2>(model, seeds);
  model.output.history = {of_point(9.7, 10.3), of_point(9.7, 16.3), of_point(9.7, 17.7)};
  const Tracers<2> tracers(model, system);
  Stepper<2> stepper(model, system);
  for (int step = 0; step < 10; ++step) stepper.advance(1e-3);
  CHECK(tracers.measure(system, 0, false).displacement.norm() < 1e-12);
  for (const std::size_t k : {1U, 2U}) {
    const Measures m = tracers.measure(system, k, false);
    CHECK((m.displacement - Vec3(0, -0.02, 0)).norm() < 1e-12);
    CHECK((m.momentum / m.mass - Vec3(0, -2, 0)).norm() < 1e-12);
  }
}
