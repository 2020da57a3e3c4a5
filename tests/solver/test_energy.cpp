// SPDX-License-Identifier: MIT
/// What the transfers dissipate.
#include "cloud.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

double lost_in_transfers(Stepper<2>& stepper, System<2>& system) {
  return stepper.ledger().transfer_loss(measure(system).kinetic);
}

// Kinetic energy of the nodes, from momenta or velocities.
double kinetic_of_nodes(const Field<2>& field, bool momenta) {
  double sum = 0.0;
  for (const Node& node : field.nodes)
    for (int d = 0; d < 2 && node.mass > 0; ++d)
      sum += momenta ? 0.5 * node.momentum[d] * node.momentum[d] / node.mass
                     : 0.5 * node.mass * node.velocity[d] * node.velocity[d];
  return sum;
}

// Particles of 250 kg with velocities +1 and -1 m/s, both at one place.
std::vector<Seed> opposite_particles(const Model& model) {
  std::vector<Seed> seeds = lattice_seeds<2>(model, 8, 9, 1);
  seeds.push_back(seeds[0]);
  for (Seed& s : seeds) s.mass = 250, s.volume = 0.25, s.half_size.head<2>().setConstant(0.25);
  return seeds;
}

}  // namespace

TEST_CASE("two particles that meet: what each transfer dissipates", "[energy]") {
  struct Row {
    Transfer transfer;
    double fraction, kept;  // FLIP fraction; of the velocities
  };
  const Row row = GENERATE(Row{Transfer::pic, 0, 0}, Row{Transfer::apic, 0, 0}, Row{Transfer::flip, 1, 1},
                           Row{Transfer::blend, 0.9, 0.9}, Row{Transfer::xpic, 0, 0}, Row{Transfer::fmpm, 0, 0},
                           Row{Transfer::blend, 1.1, 1.1});  // the last one creates energy
  const Kernel kernel = GENERATE(Kernel::linear, Kernel::quadratic_spline);
  Model model = grid_model<2>(kernel, row.transfer);
  model.scheme.flip_fraction = row.fraction, model.scheme.filter_order = 3;
  auto system = build_system<2>(model, opposite_particles(model));
  auto& body = system.bodies[0];
  for (std::size_t i = 0; i < 2; ++i) body.particles.v()[0][i] = i == 0 ? 1 : -1;
  Stepper<2> stepper(model, system);
  CHECK(lost_in_transfers(stepper, system) == 0);
  stepper.advance(1e-3);
  INFO(name(kernel) << ", transfer " << static_cast<int>(row.transfer));
  CHECK(measure(system).kinetic == Approx(250 * row.kept * row.kept).margin(1e-12));
  CHECK(lost_in_transfers(stepper, system) == Approx(250 * (1 - row.kept * row.kept)).margin(1e-10));
}

TEST_CASE("the loss is that between particles and nodes, before and after the forces", "[energy]") {
  const Transfer transfer = GENERATE(Transfer::pic, Transfer::flip, Transfer::apic);
  const UpdateOrder order = GENERATE(UpdateOrder::usl, UpdateOrder::usavg);
  Model model = grid_model<2>(Kernel::quadratic_spline, transfer, order);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 12, 2, 0.1));
  auto& body = system.bodies[0];
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  set_velocity<2>(body, [&](const Vec<2>&) -> Vec<2> { return Vec<2>(any(random), any(random)); });
  for (std::size_t i = 0; i < body.particles.size(); ++i) body.particles.stress()[0][i] = 1e6 * any(random);
  settle(system);
  const double before = measure(system).kinetic;
  const auto transfers = make_transfers<2>(model.scheme);
  transfers->scatter(body, {system.fields[0].map, system.fields[0].nodes}, Scatter::momentum, false, false);
  const double scattered = kinetic_of_nodes(system.fields[0], true);
  Stepper<2> stepper(model, system);
  system.sorted = false;
  stepper.advance(1e-3);
  const double moved = kinetic_of_nodes(system.fields[0], false), after = measure(system).kinetic;
  INFO("transfer " << static_cast<int>(transfer));
  CHECK(std::abs(moved - scattered) > 0.01 * before);  // the stresses did work
  CHECK(lost_in_transfers(stepper, system) == Approx((before - scattered) + (moved - after)));
}

TEST_CASE("particle damping is a loss by damping, not of the transfer", "[energy]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 12));
  system.bodies[0].particle_damping = 10;
  set_velocity<2>(system.bodies[0], [&](const Vec<2>&) -> Vec<2> { return Vec<2>(2, 1); });
  Stepper<2> stepper(model, system);
  const double before = measure(system).kinetic;
  for (int k = 0; k < 10; ++k) stepper.advance(1e-3);
  const double taken = before - measure(system).kinetic;
  CHECK(taken == Approx(before * (1 - std::pow(0.99, 20))));
  CHECK(stepper.ledger().damping_work == Approx(taken));
  CHECK(std::abs(lost_in_transfers(stepper, system)) < 1e-10 * before);
}
