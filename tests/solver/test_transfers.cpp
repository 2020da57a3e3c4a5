// SPDX-License-Identifier: MIT
#include "base/parallel.hpp"
#include "cloud.hpp"
#include "solver/step_start.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

// Nodal velocities from a function of position, in every node that exists.
template <int Dim>
void set_nodes(Field<Dim>& field, const std::function<Vec<Dim>(const Vec<Dim>&)>& f) {
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const Vec<Dim> v = f(field.map.lattice().position(field.map.node_at(n)));
    Node& node = field.nodes[static_cast<std::size_t>(n)];
    node.mass = 1;
    for (int d = 0; d < Dim; ++d) node.velocity[d] = v[d], node.acceleration[d] = 0;
  }
}

// A cloud, stretched and sheared so that CPDI domains are parallelograms.
template <int Dim>
std::vector<Seed> cloud(const Model& model, double jitter = 0.2) {
  auto seeds = lattice_seeds<Dim>(model, 6, 14, 2, jitter);
  for (auto& s : seeds) {
    s.F(0, 0) = 1.2, s.F(0, 1) = 0.3, s.F(1, 1) = 0.9;
    s.stress << 3e4, 1e4, 0, 1e4, -2e4, 0, 0, 0, 5e3;
    if (Dim == 3) s.stress(0, 2) = s.stress(2, 0) = 7e3, s.stress(1, 2) = s.stress(2, 1) = -4e3;
    s.volume *= 1 / 1.08;
  }
  return seeds;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a linear velocity field is gathered exactly, with its gradient", "[transfer]", ((int Dim), Dim),
                       2, 3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  const Model model = grid_model<Dim>(kernel, Transfer::pic);
  auto system = build_system<Dim>(model, cloud<Dim>(model));
  settle(system);
  Mat<Dim> A = Mat<Dim>::Random();
  const Vec<Dim> b = Vec<Dim>::Random();
  set_nodes<Dim>(system.fields[0], [&](const Vec<Dim>& x) -> Vec<Dim> { return A * x + b; });
  auto& body = system.bodies[0];
  std::vector<Vec<Dim>> start;
  for (std::size_t i = 0; i < body.particles.size(); ++i) start.push_back(body.particles.position(i));
  Gather what;
  what.move = true, what.flip = 0.0, what.dt = 1e-3, what.strain_dt = 1e-9;
  make_transfers<Dim>(model.scheme)->gather(body, {system.fields[0].map, system.fields[0].nodes}, what);
  double worst = 0, strain = 0;
  const auto volume = body.particles.volume();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    worst = std::max(worst, (body.particles.velocity(i) - (A * start[i] + b)).norm());
    strain = std::max(strain, std::abs((volume[i] / (std::pow(0.5, Dim)) - 1) / 1e-9 - A.trace()));
  }
  CHECK(worst < 1e-12);  // 1e-13 relative to |A x| of about 30
  CHECK(strain < 1e-5);  // (1 + tr A dt) with dt = 1e-9: round-off 1e-16 / 1e-9 and dt
}

TEMPLATE_TEST_CASE_SIG("the scatter conserves mass and momentum and gives no net internal force", "[transfer]",
                       ((int Dim), Dim), 2, 3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic);
  INFO(name(kernel));
  const Model model = grid_model<Dim>(kernel, transfer);
  auto system = build_system<Dim>(model, cloud<Dim>(model));
  settle(system);
  auto& body = system.bodies[0];
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  set_velocity<Dim>(body,
                    [&](const Vec<Dim>&) -> Vec<Dim> { return Vec<Dim>::NullaryExpr([&] { return unit(random); }); });
  if (body.affine)
    for (std::size_t k = 0; k < Dim * Dim; ++k)
      for (std::size_t i = 0; i < body.particles.size(); ++i) body.particles[body.affine][k][i] = 0.1 * unit(random);
  auto& field = system.fields[0];
  make_transfers<Dim>(model.scheme)->scatter(body, {field.map, field.nodes}, Scatter::momentum_and_force, false, false);
  double mass = 0, scale = 0;
  Vec3 momentum = Vec3::Zero(), force = Vec3::Zero(), moment = Vec3::Zero(), spin = Vec3::Zero();
  for (std::int64_t n = 0; n < field.map.node_count(); ++n) {
    const Node& node = field.nodes[static_cast<std::size_t>(n)];
    const Vec3 p(node.velocity), f(node.acceleration);
    Vec3 x = Vec3::Zero();
    x.head<Dim>() = system.lattice.position(field.map.node_at(n));
    mass += node.mass, momentum += p, force += f, scale += f.norm();
    moment += x.cross(f), spin += x.cross(p);
  }
  const Measures m = measure(system);
  CHECK(mass == Approx(m.mass).epsilon(1e-13));
  CHECK((momentum - m.momentum).norm() < 1e-13 * m.mass);
  CHECK(force.norm() < 1e-13 * scale);
  CHECK(moment.norm() < 1e-12 * scale * 10);  // sigma is symmetric: no net moment
  if (transfer == Transfer::apic && kernel != Kernel::linear)
    CHECK((spin - m.angular_momentum).norm() < 1e-12 * m.mass * 10);
}

TEMPLATE_TEST_CASE_SIG("affine transfers conserve angular momentum both ways", "[transfer]", ((int Dim), Dim), 2, 3) {
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline, Kernel::cubic_spline, Kernel::cpdi);
  INFO(name(kernel));
  Model model = grid_model<Dim>(kernel, Transfer::apic);
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 6, 12, 2, 0.2));
  auto& body = system.bodies[0];
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  set_velocity<Dim>(body, [&](const Vec<Dim>& x) -> Vec<Dim> {
    Vec<Dim> v = Vec<Dim>::NullaryExpr([&] { return 0.3 * unit(random); });
    v[0] -= x[1] - 9, v[1] += x[0] - 9;
    return v;
  });
  Stepper<Dim> stepper(model, system);
  const Vec3 before = measure(system).angular_momentum;
  stepper.advance(1e-9);  // no stress yet: one transfer there and back
  const Vec3 after = measure(system).angular_momentum;
  CHECK((after - before).norm() < 1e-12 * measure(system).mass * 20);
}

TEMPLATE_TEST_CASE_SIG("any number of threads gives the same bits", "[transfer][threads]", ((int Dim), Dim), 2, 3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  const Model model = grid_model<Dim>(kernel, Transfer::apic);
  const auto run = [&](int count) {
    set_threads(count);
    auto system = build_system<Dim>(model, cloud<Dim>(model));
    set_velocity<Dim>(system.bodies[0],
                      [&](const Vec<Dim>& x) -> Vec<Dim> { return Vec<Dim>::Constant(std::sin(x.sum())); });
    Stepper<Dim> stepper(model, system);
    for (int k = 0; k < 20; ++k) stepper.advance(1e-3);
    std::vector<double> all;
    for (const auto& c : system.bodies[0].particles.columns())
      all.insert(all.end(), c.data.begin(), c.data.end() - Particles<Dim>::padding);
    set_threads(1);
    return all;
  };
  const auto one = run(1), two = run(2), five = run(5);
  CHECK(one == two);
  CHECK(one == five);
}

TEMPLATE_TEST_CASE_SIG("a gather and a scatter in one pass give the bits of one after the other", "[transfer]",
                       ((int Dim), Dim), 2, 3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic, Transfer::fmpm);
  INFO(name(kernel));
  Model model = grid_model<Dim>(kernel, transfer);
  model.scheme.extrapolate_again = true;
  const auto transfers = make_transfers<Dim>(model.scheme);
  Gather filter, move, strain;
  filter.task = GatherTask::filtered_velocity;
  move.move = true, move.dt = 1e-3;
  strain.strain_dt = 1e-3;
  const auto run = [&](const Gather& what, Scatter sums, bool in_one_pass) {
    auto system = build_system<Dim>(model, cloud<Dim>(model));
    Stepper<Dim> stepper(model, system);
    stepper.advance(1e-6);  // sorts and locates the nodes
    auto& body = system.bodies[0];
    auto& field = system.fields[0];
    keep_start_positions(system), keep_start_domains(system);
    set_nodes<Dim>(field, [](const Vec<Dim>& x) -> Vec<Dim> { return Vec<Dim>::Constant(std::sin(x.sum())); });
    NodeLayer to(field.nodes.size());
    const Target<Dim> from(field.map, field.nodes), target(field.map, to);
    if (in_one_pass) {
      CHECK(transfers->gather_and_scatter(body, from, what, target, sums, false).valid);
    } else {
      CHECK(transfers->gather(body, from, what).valid);
      transfers->scatter(body, target, sums, what.move, false);
    }
    std::vector<double> all;
    for (const auto& c : body.particles.columns())
      all.insert(all.end(), c.data.begin(), c.data.end() - Particles<Dim>::padding);
    for (const Node& node : to) {
      all.push_back(node.mass);
      for (int d = 0; d < Dim; ++d) all.push_back(node.momentum[d]), all.push_back(node.force[d]);
    }
    return all;
  };
  const auto same = [&](const Gather& what, Scatter sums) { return run(what, sums, true) == run(what, sums, false); };
  if (transfer == Transfer::fmpm) CHECK(same(filter, Scatter::filtered));
  CHECK(same(move, Scatter::momentum));
  CHECK(same(strain, Scatter::force));
  CHECK(same(move, Scatter::momentum_and_force));  // which no pass does at once
}

TEST_CASE("the affine moment is the kernel's second moment", "[transfer]") {
  // D = sum w (x_i - x)^2 along an axis, seen through the gather of v = x: B = D. Values at xi = 0, 1/4, 1/2.
  const auto [kernel, expected] =
      GENERATE(table<Kernel, std::array<double, 3>>({{Kernel::quadratic_spline, {0.25, 0.25, 0.25}},
                                                     {Kernel::cubic_spline, {1.0 / 3, 1.0 / 3, 1.0 / 3}},
                                                     {Kernel::linear, {0.0, 0.1875, 0.25}},
                                                     {Kernel::gimp, {0.125, 0.1875, 0.25}}}));
  INFO(name(kernel));
  Model model = grid_model<2>(kernel, Transfer::apic);
  for (int k = 0; k < 3; ++k) {
    Seed s;
    s.x = Vec3(10 + 0.25 * k, 10 + 0.25 * k, 0), s.half_size = Vec3(0.25, 0.25, 0), s.volume = 0.25, s.mass = 1;
    auto system = build_system<2>(model, {s});
    settle(system);
    set_nodes<2>(system.fields[0], [](const Vec<2>& x) { return x; });
    Gather what;
    what.move = true, what.dt = 1e-12, what.flip = 0;
    auto& body = system.bodies[0];
    make_transfers<2>(model.scheme)->gather(body, {system.fields[0].map, system.fields[0].nodes}, what);
    const auto B = [&](std::size_t c) { return body.particles[body.affine][c][0]; };
    CHECK(std::abs(B(0) - expected[static_cast<std::size_t>(k)]) < 1e-13);
    CHECK(std::abs(B(3) - expected[static_cast<std::size_t>(k)]) < 1e-13);
    CHECK(std::abs(B(1)) < 1e-13);
    CHECK(std::abs(B(2)) < 1e-13);
  }
}
