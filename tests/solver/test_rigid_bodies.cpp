// SPDX-License-Identifier: MIT
/// Rigid bodies whose velocity is a function of the position.

#include "cloud.hpp"
#include "contact/contact_cases.hpp"

#include "solver/state/particle_domain.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

// A square of rigid particles around the centre of the grid that moves with the given velocities, and a deformable body
// far from it.
Model rigid_square(const char* vx, const char* vy) {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip);
  add_rigid_tool(model, vx, vy);
  return model;
}

System<2> system_of_square(const Model& model) {
  auto seeds = lattice_seeds<2>(model, 2, 4);
  for (auto seed : lattice_seeds<2>(model, 10, 14)) seed.material = 1, seeds.push_back(seed);
  return build_system<2>(model, seeds);
}

// Largest distance of the particles from their initial positions, turned by an angle about the centre and enlarged.
double misplaced(Body<2>& body, double angle, double size = 1) {
  const Mat<2> to = size * Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Vec<2> middle(12, 12);
  const auto x = body.particles.x(), start = body.particles[body.origin];
  double most = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    most =
        std::max(most, (Vec<2>(x[0][i], x[1][i]) - middle - to * (Vec<2>(start[0][i], start[1][i]) - middle)).norm());
  return most;
}

}  // namespace

TEST_CASE("a rotating rigid body keeps its size, and its domains turn with it", "[rigid]") {
  const Model model = rigid_square("-2*pi*(y-12)", "2*pi*(x-12)");
  auto system = system_of_square(model);
  Body<2>& body = system.rigids[0];
  Stepper<2> stepper(model, system);
  constexpr int steps = 800;
  for (int k = 1; k <= 2 * steps; ++k) {
    stepper.advance(1.0 / steps);
    if (k != steps / 8 && k != steps / 4 && k != 2 * steps) continue;
    const double angle = 2 * M_PI * k / steps;
    CHECK(misplaced(body, angle) < 5e-4);  // (2 pi/800)^2/6 of the angle, at a distance of 2.5
    const ParticleDomain<2> domain = DomainReader<2>(body)(0);
    const Mat<2> sides = 0.25 * Eigen::Rotation2Dd(angle).toRotationMatrix();
    CHECK((domain.axes - sides).norm() < 1e-4);
  }
  // A step dt V(x) without the mid-step position would enlarge all distances by 1 + (2 pi/800)^2/2 in each step, by 5
  // %.
  const auto F = body.particles.F();
  CHECK(load_full<2>(F, 0).determinant() == Approx(1).margin(1e-5));
}

TEST_CASE("a velocity field has no nodes at a rigid body out of its reach", "[rigid]") {
  const Model model = rigid_square("0", "0");
  auto system = system_of_square(model);
  Stepper<2> stepper(model, system);
  stepper.advance(1e-3);
  const auto node_at = [&](Body<2>& body) {
    const auto x = body.particles.x();
    Index<2> node;
    for (std::size_t d = 0; d < 2; ++d)
      node[d] = static_cast<int>((x[d][0] - system.lattice.origin[static_cast<Eigen::Index>(d)]) /
                                 system.lattice.spacing[static_cast<Eigen::Index>(d)]);
    return system.fields[0].map.node(node);
  };
  CHECK(node_at(system.bodies[0]) >= 0);
  CHECK(node_at(system.rigids[0]) == -1);
}

TEST_CASE("the domains of a rigid body that grows grow with it", "[rigid]") {
  const Model model = rigid_square("0.5*(x-12)", "0.5*(y-12)");
  auto system = system_of_square(model);
  Body<2>& body = system.rigids[0];
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 100; ++k) stepper.advance(1e-2);
  CHECK(misplaced(body, 0, std::exp(0.5)) < 1e-4);
  CHECK((DomainReader<2>(body)(0).axes - 0.25 * std::exp(0.5) * Mat<2>::Identity()).norm() < 1e-4);
}

TEST_CASE("a rigid body with a velocity of time alone moves as before, its domains do not change", "[rigid]") {
  const Model model = rigid_square("2*t", "0");
  auto system = system_of_square(model);
  Body<2>& body = system.rigids[0];
  Stepper<2> stepper(model, system);
  const double first = body.particles.x()[0][0];
  for (int k = 0; k < 10; ++k) stepper.advance(1e-2);
  CHECK(body.particles.x()[0][0] - first == Approx(1e-2 * 2 * 1e-2 * 55));  // sum of dt v(t + dt)
  CHECK(DomainReader<2>(body)(0).axes == Mat<2>(0.25 * Mat<2>::Identity()));
}
