// SPDX-License-Identifier: MIT
#include "cloud.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace tribo;
using namespace tribo::test;

namespace {

// A jittered block with random velocities and stresses, before its first step.
template <int Dim>
System<Dim> excited(const Model& model, double stress) {
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 2, 7, 2, 0.2));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  auto& body = system.bodies[0];
  set_velocity<Dim>(body,
                    [&](const Vec<Dim>&) -> Vec<Dim> { return Vec<Dim>::NullaryExpr([&] { return value(random); }); });
  for (double* component : body.particles.stress())
    for (std::size_t i = 0; i < body.particles.size(); ++i) component[i] = stress * value(random);
  return system;
}

template <int Dim>
Model with_means(Kernel kernel, UpdateOrder order, bool again) {
  Model model = grid_model<Dim>(kernel, Transfer::flip, order, again, 9);
  model.scheme.b_bar = true;
  return model;
}

using Totals = std::map<std::array<int, 3>, std::array<double, 3>>;  // cell -> smallest, largest rate; flow of volume

// Relative changes of volume in one short step, by the cell that the particles are in.
template <int Dim>
Totals rates(const Model& model) {
  static constexpr double dt = 1e-7;
  auto system = excited<Dim>(model, 0.0);
  Stepper<Dim>(model, system).advance(dt);
  Totals totals;
  const auto& particles = system.bodies[0].particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    std::array<int, 3> cell{};
    for (int d = 0; d < Dim; ++d) cell[static_cast<std::size_t>(d)] = static_cast<int>(particles.position(i)[d]);
    const double before = std::pow(0.5, Dim), rate = (particles.volume()[i] / before - 1) / dt;
    const auto [entry, fresh] = totals.try_emplace(cell, std::array{rate, rate, 0.0});
    auto& [least, most, flow] = entry->second;
    least = std::min(least, rate), most = std::max(most, rate), flow += before * rate;
  }
  return totals;
}

template <int Dim>
void check_means(Kernel kernel, UpdateOrder order, bool again) {
  Model model = with_means<Dim>(kernel, order, again);
  const Totals with = rates<Dim>(model);
  model.scheme.b_bar = false;
  const Totals without = rates<Dim>(model);
  REQUIRE(with.size() == without.size());
  double spread = 0.0;
  for (const auto& [cell, total] : with) {
    const auto& [least, most, flow] = total;
    const auto& [own_least, own_most, own_flow] = without.at(cell);
    CHECK(most - least < 1e-5);  // (L dt)^2 / dt, and round-off of the volume ratio over dt
    CHECK(flow == Approx(own_flow).margin(1e-5));
    spread = std::max(spread, own_most - own_least);
  }
  CHECK(spread > 0.2);
}

}  // namespace

TEST_CASE("with B-bar, particles of a cell change volume alike, and cells as they would without", "[b_bar]") {
  const auto kernel = GENERATE(Kernel::linear, Kernel::cpdi);
  const auto [order, again] = GENERATE(table<UpdateOrder, bool>(
      {{UpdateOrder::usl, false}, {UpdateOrder::usl, true}, {UpdateOrder::usf, false}, {UpdateOrder::usavg, true}}));
  INFO(name(kernel) << " " << static_cast<int>(order) << again);
  check_means<2>(kernel, order, again);
  check_means<3>(kernel, order, again);
}

// What forces take from the motion is what strains store, to second order in the step; not so if only the strains, or
// only the forces, use means.
TEMPLATE_TEST_CASE_SIG("with B-bar, energy goes from motion to strain", "[b_bar]", ((int Dim), Dim), 2, 3) {
  const auto kernel = GENERATE(Kernel::linear, Kernel::cpdi);
  Model model = with_means<Dim>(kernel, UpdateOrder::usl, false);
  model.materials[0].law = elastic(1e-3);  // light, so that what is exchanged is no small part of the energy
  double imbalance[2];
  for (const int half : {0, 1}) {
    auto system = excited<Dim>(model, 10.0);  // small against E = 1e6: the law is elastic for small strains
    const Measures before = measure(system);
    Stepper<Dim>(model, system).advance(1e-8 / (1 + half));
    const Measures after = measure(system);
    const double stored = after.stored - before.stored;
    imbalance[half] = (stored + after.kinetic - before.kinetic) / std::abs(stored);
  }
  CHECK(std::abs(imbalance[0]) < 0.02);
  CHECK(imbalance[1] / imbalance[0] == Approx(0.5).epsilon(0.1));
}

TEST_CASE("B-bar in axisymmetry includes the hoop strain", "[b_bar]") {
  Model model = with_means<2>(Kernel::linear, UpdateOrder::usl, false);
  model.analysis = Analysis::axisymmetric;
  auto system = build_system<2>(model, lattice_seeds<2>(model, 2, 7));
  auto& body = system.bodies[0];
  static constexpr double dt = 1e-6, mu = 1e6 / 2.6;
  set_velocity<2>(body, [](const Vec<2>& x) -> Vec<2> { return {x[0], -2 * x[1]}; });  // keeps every volume
  Stepper<2>(model, system).advance(dt);
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<2> x = body.particles.position(i);
    if ((x.array() < 3).any() || (x.array() > 6).any()) continue;
    const auto stress = body.particles.stress();
    CHECK(stress[0][i] == Approx(2 * mu * dt).epsilon(1e-4));
    CHECK(stress[1][i] == Approx(-4 * mu * dt).epsilon(1e-4));
    CHECK(stress[2][i] == Approx(2 * mu * dt).epsilon(1e-4));
  }
}
