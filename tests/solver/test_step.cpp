// SPDX-License-Identifier: MIT
#include "cloud.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace tribo;
using namespace tribo::test;

namespace {

// Gain of one transfer step for v = cos(kappa x) in the middle of a wide strip, 2 particles per cell at quarter points.
double gain(Kernel kernel, Transfer transfer, int order, int wavelength) {
  Model model = grid_model<2>(kernel, transfer, UpdateOrder::usl, false, 64);
  model.scheme.filter_order = order;
  auto system = build_system<2>(model, lattice_seeds<2>(model, 0, 64));
  auto& body = system.bodies[0];
  const double kappa = 2 * M_PI / wavelength;
  // The projection of nodal values g gives particles sum S g; the eigenvector of S+ S is the nodal cosine
  set_velocity<2>(body, [&](const Vec<2>&) -> Vec<2> { return Vec<2>::Zero(); });
  settle(system);
  auto& field = system.fields[0];
  const auto transfers = make_transfers<2>(model.scheme);
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    Node& node = field.nodes[static_cast<std::size_t>(n)];
    node.velocity[0] = std::cos(kappa * (field.map.node_at(n)[0] - Lattice<2>::padding));
  }
  Gather what;
  what.move = true, what.flip = 0, what.dt = 1e-12;
  transfers->gather(body, {field.map, field.nodes}, what);
  // Now v_p = S g. One scatter gives lambda g on the nodes; a whole step gives the filter's gain times S g.
  std::vector<double> before;
  for (std::size_t i = 0; i < body.particles.size(); ++i) before.push_back(body.particles.velocity(i)[0]);
  std::vector<std::int64_t> ids = body.particles.id;
  Stepper<2> stepper(model, system);
  system.sorted = false;
  stepper.advance(1e-12);
  double top = 0, bottom = 0;
  std::vector<double> by_id(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) by_id[static_cast<std::size_t>(ids[i])] = before[i];
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vec<2> x = body.particles.position(i);
    if (x[0] < 28 || x[0] > 36 || x[1] < 28 || x[1] > 36) continue;  // far from the edges for any order used here
    const double old = by_id[static_cast<std::size_t>(body.particles.id[i])];
    top += old * body.particles.velocity(i)[0], bottom += old * old;
  }
  return top / bottom;
}

}  // namespace

TEST_CASE("the filter's eigenvalue is the closed form of each kernel, and FMPM(k) gains 1 - (1 - lambda)^k", "[step]") {
  struct Row {
    Kernel kernel;
    double quarter, half, full;  // kappa h = pi/4, pi/2, pi
  };
  const Row row = GENERATE(Row{Kernel::linear, 0.89016504294495546, 0.625, 0.25},
                           Row{Kernel::quadratic_spline, 0.85656872, 0.53515625, 0.140625},
                           Row{Kernel::cubic_spline, 0.81322755, 0.43126085, 0.05251736});
  INFO(name(row.kernel));
  for (const auto& [wavelength, lambda] : {std::pair{8, row.quarter}, {4, row.half}, {2, row.full}}) {
    CHECK(gain(row.kernel, Transfer::pic, 1, wavelength) == Approx(lambda).margin(1e-8));
    for (const int k : {1, 2, 4}) {
      CHECK(gain(row.kernel, Transfer::fmpm, k, wavelength) == Approx(1 - std::pow(1 - lambda, k)).margin(1e-8));
      CHECK(gain(row.kernel, Transfer::xpic, k, wavelength) == Approx(1 - std::pow(1 - lambda, k)).margin(1e-8));
    }
    CHECK(gain(row.kernel, Transfer::flip, 1, wavelength) == Approx(1).margin(1e-10));
  }
}

TEST_CASE("the alternating mode in every cell survives FLIP and nothing else", "[step]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const auto [transfer, kept] = GENERATE(table<Transfer, double>({{Transfer::flip, 1.0},
                                                                  {Transfer::pic, 0.0},
                                                                  {Transfer::xpic, 0.0},
                                                                  {Transfer::fmpm, 0.0},
                                                                  {Transfer::apic, 0.0}}));
  INFO(name(kernel));
  // Both neighbours of a node lie at the same distance with opposite velocities in the interior
  Model model = grid_model<2>(kernel, transfer, UpdateOrder::usl, false, 40);
  model.scheme.filter_order = 3;
  auto system = build_system<2>(model, lattice_seeds<2>(model, 2, 38));
  auto& body = system.bodies[0];
  set_velocity<2>(body,
                  [](const Vec<2>& x) -> Vec<2> { return Vec<2>(x[0] - std::floor(x[0]) < 0.5 ? 1.0 : -1.0, 0.0); });
  Stepper<2> stepper(model, system);
  stepper.advance(1e-12);
  int checked = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<2> x = body.particles.position(i);
    if ((x.array() < 18).any() || (x.array() > 22).any()) continue;  // edges spread by three cells per filter pass
    const double start = x[0] - std::floor(x[0]) < 0.5 ? 1.0 : -1.0;
    CHECK(std::abs(body.particles.velocity(i)[0] - kept * start) < 1e-14);
    ++checked;
  }
  CHECK(checked == 64);
  // FLIP keeps velocities that the nodes do not see; they have the mass of the particles, and no velocity.
  int nodes = 0;
  const auto& field = system.fields[0];
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const Vec<2> x = system.lattice.position(field.map.node_at(n));
    if ((x.array() < 17.5).any() || (x.array() > 22.5).any()) continue;
    CHECK(field.nodes[static_cast<std::size_t>(n)].mass == Approx(1000));
    CHECK(std::abs(field.nodes[static_cast<std::size_t>(n)].velocity[0]) < 1e-12);
    ++nodes;
  }
  CHECK(nodes == 25);
}

TEMPLATE_TEST_CASE_SIG("a free flight across cells leaves velocity and stress alone", "[step]", ((int Dim), Dim), 2,
                       3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::fmpm, Transfer::apic);
  const UpdateOrder order = GENERATE(UpdateOrder::usl, UpdateOrder::usavg);
  // With hats the affine part keeps the velocity difference between a heavy and an almost massless edge node, which no
  // time step integrates stably; other transfers average it away.
  if (kernel == Kernel::linear && transfer == Transfer::apic) return;
  INFO(name(kernel) << ", transfer " << static_cast<int>(transfer) << ", order " << static_cast<int>(order));
  Model model = grid_model<Dim>(kernel, transfer, order, true, Dim == 2 ? 80 : 24);
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 3, Dim == 2 ? 13 : 6));
  Vec<Dim> v = Vec<Dim>::Constant(10.0);
  v[1] = 7;
  set_velocity<Dim>(system.bodies[0], [&](const Vec<Dim>&) { return v; });
  std::map<std::int64_t, Vec<Dim>> start;
  for (std::size_t i = 0; i < system.bodies[0].particles.size(); ++i)
    start[system.bodies[0].particles.id[i]] = system.bodies[0].particles.position(i);
  Stepper<Dim> stepper(model, system);
  const int steps = Dim == 2 ? 500 : 120;
  for (int k = 0; k < steps; ++k) stepper.advance(0.01);
  auto& body = system.bodies[0];
  double velocity = 0, stress = 0, position = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<Dim> end = start.at(body.particles.id[i]) + 0.01 * steps * v;
    position = std::max(position, (body.particles.position(i) - end).cwiseAbs().maxCoeff());
    velocity = std::max(velocity, (body.particles.velocity(i) - v).cwiseAbs().maxCoeff());
    stress = std::max(stress, load_symmetric<Dim>(body.particles.stress(), static_cast<int>(i)).cwiseAbs().maxCoeff());
  }
  CHECK(velocity < 1e-12 * 10);
  CHECK(position < 1e-10);
  CHECK(stress < 1e-11 * 1e6);  // of E: round-off strains of every step, 1e-16 v dt / h, grow with their number
}

TEST_CASE("a radial motion in proportion to the radius strains along the hoop as along the radius", "[step]") {
  const auto order = GENERATE(UpdateOrder::usf, UpdateOrder::usl, UpdateOrder::usavg);
  const bool again = GENERATE(false, true);
  INFO("order " << static_cast<int>(order) << ", again " << again);
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip, order, again);
  model.analysis = Analysis::axisymmetric;
  auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 14));
  auto& particles = system.bodies[0].particles;
  set_velocity<2>(system.bodies[0], [](const Vec<2>& x) { return Vec<2>(0.5 * x[0], 0); });
  Stepper<2> stepper(model, system);
  stepper.advance(1e-3);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if ((particles.position(i) - Vec<2>(9, 9)).cwiseAbs().maxCoeff() > 2) continue;  // edges round off the motion
    const Mat3 stress = load_symmetric<2>(particles.stress(), static_cast<int>(i));
    CHECK(stress(0, 0) == Approx(1e6 * 0.5e-3 / (1.3 * 0.4)).epsilon(1e-3));  // E/((1 + nu) (1 - 2 nu)) times strain
    // the stress of the first half of the step of USAVG changes the velocities a little
    CHECK(stress(2, 2) == Approx(stress(0, 0)).epsilon(order == UpdateOrder::usavg ? 5e-5 : 1e-12));
  }
}

TEST_CASE("every step conserves momentum to round-off", "[step]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::xpic, Transfer::fmpm, Transfer::apic);
  const auto order = GENERATE(UpdateOrder::usf, UpdateOrder::usl, UpdateOrder::usavg);
  INFO(name(kernel));
  Model model = grid_model<2>(kernel, transfer, order, true);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16, 2, 0.05));
  set_velocity<2>(system.bodies[0],
                  [](const Vec<2>& x) -> Vec<2> { return Vec<2>(std::sin(x[1]), std::cos(0.7 * x[0])); });
  Stepper<2> stepper(model, system);
  const double scale = measure(system).mass;
  Vec3 before = measure(system).momentum;
  for (int k = 0; k < 50; ++k) {
    stepper.advance(2e-3);
    const Vec3 after = measure(system).momentum;
    REQUIRE((after - before).norm() < 1e-13 * scale);
    before = after;
  }
  // The motion had stresses: the test is not one of a free flight.
  auto& body = system.bodies[0];
  double stress = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    stress = std::max(stress, load_symmetric<2>(body.particles.stress(), static_cast<int>(i)).cwiseAbs().maxCoeff());
  CHECK(stress > 1e3);
  CHECK(before.norm() > 1e-3 * scale);
}

TEST_CASE("a particle that leaves the grid stops the run by name, or is put back", "[step]") {
  Model model = grid_model<2>(Kernel::gimp, Transfer::flip);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 1, 3));
  set_velocity<2>(system.bodies[0], [](const Vec<2>&) -> Vec<2> { return Vec<2>(-10.0, 0.0); });
  SECTION("stops") {
    Stepper<2> stepper(model, system);
    REQUIRE_THROWS_WITH(
        [&] {
          for (int k = 0; k < 100; ++k) stepper.advance(1e-2);
        }(),
        Catch::Contains("of 'block'") && Catch::Contains("left the grid") && Catch::Contains("in step"));
  }
  SECTION("is put back") {
    model.leave_limit = 100000;
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 40; ++k) stepper.advance(1e-2);
    CHECK(stepper.particle_sort().returned > 0);
  }
}

TEST_CASE("a velocity that is not a number stops the run by name", "[step]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
  system.bodies[0].particles.v()[0][5] = std::nan("");
  Stepper<2> stepper(model, system);
  REQUIRE_THROWS_WITH(stepper.advance(1e-3), Catch::Contains("not a number"));
}
