// SPDX-License-Identifier: MIT
#include "cloud.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr int period = 10;

double wrapped(double x) { return x - period * std::floor(x / period); }

// Where particles are and how fast, by number, after a while. The cloud fills a band around a periodic grid; it flies
// along x fast enough to go around, strains and vibrates.
template <int Dim>
std::map<std::int64_t, std::array<double, 6>> after_a_while(const Model& model, int shift) {
  auto seeds = lattice_seeds<Dim>(model, 2, 6, 2, 0.2);
  for (Seed& s : seeds) s.x[0] = wrapped(s.x[0] + 4.5 + shift);
  auto system = build_system<Dim>(model, seeds);
  set_velocity<Dim>(system.bodies[0], [&](const Vec<Dim>& x) -> Vec<Dim> {
    Vec<Dim> v = Vec<Dim>::Zero();
    v[0] = 250 + std::sin(2 * M_PI * (x[0] - shift) / period), v[1] = 2 * std::cos(2 * M_PI * (x[0] - shift) / period);
    return v;
  });
  Stepper<Dim> stepper(model, system);
  for (int step = 0; step < 150; ++step) stepper.advance(5e-4);
  std::map<std::int64_t, std::array<double, 6>> out;
  const auto& particles = system.bodies[0].particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    auto& row = out[particles.id[i]];
    for (int d = 0; d < Dim; ++d)
      row[static_cast<std::size_t>(d)] = particles.position(i)[d],
      row[static_cast<std::size_t>(3 + d)] = particles.velocity(i)[d];
  }
  return out;
}

template <int Dim>
Model periodic_model(Kernel kernel, Transfer transfer) {
  Model model = grid_model<Dim>(kernel, transfer, UpdateOrder::usavg, true, period);
  model.grid.periodic[0] = true;
  model.scheme.filter_order = 2;
  return model;
}

template <int Dim>
void check_shift(const Model& model) {
  const auto here = after_a_while<Dim>(model, 0), there = after_a_while<Dim>(model, 3);
  for (const auto& [id, a] : here) {
    const auto& b = there.at(id);
    CHECK(std::abs(std::remainder(b[0] - a[0] - 3, period)) < 1e-9);
    for (std::size_t k = 1; k < 6; ++k) CHECK(std::abs(b[k] - a[k]) < (k < 3 ? 1e-9 : 1e-6));
  }
}

}  // namespace

TEST_CASE("results do not depend on the origin of a periodic grid", "[periodic]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::fmpm);
  INFO(name(kernel));
  check_shift<2>(periodic_model<2>(kernel, transfer));
}

TEST_CASE("means over cells go across the edge, too", "[periodic][b_bar]") {
  auto model = periodic_model<2>(Kernel::linear, Transfer::flip);
  model.scheme.b_bar = true;
  check_shift<2>(model);
}

TEST_CASE("a periodic grid in three dimensions, two axes", "[periodic]") {
  auto model = periodic_model<3>(Kernel::quadratic_spline, Transfer::flip);
  model.grid.periodic[2] = true;
  check_shift<3>(model);
}

TEST_CASE("a body that passes a periodic edge keeps its momentum, and its displacement continues", "[periodic]") {
  const auto model = periodic_model<2>(Kernel::quadratic_spline, Transfer::flip);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 0, period, 2, 0.1));
  auto& body = system.bodies[0];
  set_velocity<2>(body, [](const Vec<2>& x) -> Vec<2> { return {200 + std::sin(2 * M_PI * x[0] / period), 0}; });
  const auto momentum = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      sum += body.particles.mass()[i] * body.particles.velocity(i)[0];
    return sum;
  };
  const double before = momentum();
  Stepper<2> stepper(model, system);
  for (int step = 0; step < 200; ++step) stepper.advance(5e-4);
  CHECK(momentum() == Approx(before).epsilon(1e-12));
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    CHECK(body.particles.position(i)[0] > -1);
    CHECK(body.particles.position(i)[0] - body.particles[body.origin][0][i] == Approx(20).margin(0.2));
  }
}

TEST_CASE("one cell may be a whole period", "[periodic]") {
  Model model = grid_model<2>(Kernel::cubic_spline, Transfer::flip, UpdateOrder::usl, false, period);
  model.grid.periodic[0] = true, model.grid.high[0] = 1, model.grid.cells[0] = 1;
  std::vector<Seed> seeds;
  for (Seed s : lattice_seeds<2>(model, 2, 6, 2)) {
    if (s.x[0] < 3) s.x[0] -= 2, seeds.push_back(s);
  }
  auto system = build_system<2>(model, seeds);
  set_velocity<2>(system.bodies[0], [](const Vec<2>&) -> Vec<2> { return {100, 0}; });
  Stepper<2> stepper(model, system);
  for (int step = 0; step < 100; ++step) stepper.advance(5e-4);
  const auto& particles = system.bodies[0].particles;
  for (std::size_t i = 0; i < particles.size(); ++i) CHECK(particles.velocity(i)[0] == Approx(100).epsilon(1e-12));
}
