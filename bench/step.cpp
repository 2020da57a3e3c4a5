// SPDX-License-Identifier: MIT
/// Whole-step speed of cases (a) and (b): a square of 160x160 cells with 4 points each and a cube of 32^3 cells with 8,
/// linear elastic, moving and shearing. Reports CPU time per particle-step of one core, and memory per particle.
///
///   bench_step <2|3> <kernel> <transfer> <threads> [cells] [steps] [order: USL-, USL+, USAVG-, USAVG+, USF]

#include "solver/step.hpp"
#include "base/parallel.hpp"
#include "cpu_time.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <string>

using namespace tribo;

namespace {

template <int Dim>
int run(Kernel kernel, Transfer transfer, const std::string& order, int cells, int steps) {
  Model model;
  model.analysis = Dim == 2 ? Analysis::plane_strain : Analysis::solid;
  model.scheme = {};
  const bool averaged = order.starts_with("USAVG");
  model.scheme.order = order == "USF" ? UpdateOrder::usf : averaged ? UpdateOrder::usavg : UpdateOrder::usl;
  model.scheme.extrapolate_again = order.back() == '+';
  model.scheme.kernel = kernel;
  model.scheme.transfer = transfer;
  model.scheme.flip_fraction = 0.99;

  const double h = 1.0 / cells;
  const int pad = 6;
  Vec<Dim> low = Vec<Dim>::Constant(-pad * h), high = Vec<Dim>::Constant(1 + pad * h);
  Index<Dim> count;
  count.fill(cells + 2 * pad);
  System<Dim> system{Lattice<Dim>(low, high, count)};
  system.analysis = model.analysis;
  system.fields.emplace_back(system.lattice);

  Statement statement;
  for (auto [name, text] : {std::pair{"rho", "1000"}, {"E", "1e6"}, {"nu", "0.3"}}) {
    Statement child;
    child.name = name, child.text = text;
    statement.children.push_back(child);
  }
  Problems problems;
  std::shared_ptr<const Material> law = materials().find("LinearElastic")->make(statement, {}, {}, problems);
  problems.raise();

  const int m = 2 * cells;
  std::size_t n = 1;
  for (int d = 0; d < Dim; ++d) n *= static_cast<std::size_t>(m);
  auto transfers = make_transfers<Dim>(model.scheme);
  Body<Dim> body(n, law->needs_deformation() || kernel == Kernel::cpdi, transfers->shift(),
                 transfers->colours_per_axis());
  body.name = "block", body.law = law;
  body.uniform_half_size.setConstant(h / 4);
  body.origin = body.particles.add_vector("origin", Dimension::length);
  if (model.scheme.extrapolate_again) body.start = body.particles.add_vector("start_position", Dimension::length);
  if (kernel == Kernel::cpdi) body.domain = body.particles.add_matrix("domain", Dimension::none);
  if (transfer == Transfer::apic) body.affine = body.particles.add_matrix("affine", Dimension::none);
  if (transfer == Transfer::fmpm || transfer == Transfer::xpic)
    body.filtered = body.particles.add_vector("filtered", Dimension::velocity);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-h / 4, h / 4);
  if (body.particles.has_deformation())
    for (const std::size_t diagonal : {std::size_t{0}, std::size_t{Dim + 1}, std::size_t{Layout<Dim>::full - 1}})
      std::fill_n(body.particles.F()[diagonal], n, 1.0);
  auto x = body.particles.x();
  auto v = body.particles.v();
  const double c = std::sqrt(law->wave_modulus() / 1000);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t rest = i;
    for (std::size_t d = 0; d < Dim; ++d)
      x[d][i] = (static_cast<double>(rest % static_cast<std::size_t>(m)) + 0.5) * h / 2 + jitter(random),
      rest /= static_cast<std::size_t>(m);
    for (std::size_t d = 0; d < Dim; ++d) v[d][i] = 0.01 * c * (0.7 + 0.3 * std::sin(6 * x[(d + 1) % Dim][i]));
    body.particles.volume()[i] = std::pow(h / 2, Dim);
    body.particles.mass()[i] = 1000 * body.particles.volume()[i];
    body.particles.id[i] = static_cast<std::int64_t>(i);
  }
  system.bodies.push_back(std::move(body));

  Stepper<Dim> stepper(model, system);
  const double dt = 0.3 * h / c;
  for (int k = 0; k < 5; ++k) stepper.advance(dt);
  const double start = cpu_seconds();
  const auto wall = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) stepper.advance(dt);
  const double cpu = cpu_seconds() - start;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double particle_steps = static_cast<double>(n) * steps;
  double momentum = 0;
  for (std::size_t i = 0; i < n; ++i)
    momentum += system.bodies[0].particles.mass()[i] * system.bodies[0].particles.v()[0][i];
  std::printf(
      "%dD %zu points %d threads: %.2f ns cpu per particle-step = %.2f M/s/core, wall %.2f ns, %.0f B/particle, p_x "
      "%.15g\n",
      Dim, n, threads(), 1e9 * cpu / particle_steps, 1e-6 * particle_steps / cpu, 1e9 * elapsed / particle_steps,
      1024.0 * static_cast<double>(usage.ru_maxrss) / static_cast<double>(n), momentum);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string dim = argc > 1 ? argv[1] : "2", kernel = argc > 2 ? argv[2] : "quadratic",
                    transfer = argc > 3 ? argv[3] : "blend";
  set_threads(argc > 4 ? std::stoi(argv[4]) : 1);
  const int cells = argc > 5 ? std::stoi(argv[5]) : dim == "2" ? 160 : 32;
  const int steps = argc > 6 ? std::stoi(argv[6]) : 100;
  const Kernel k = kernel == "linear"  ? Kernel::linear
                   : kernel == "gimp"  ? Kernel::gimp
                   : kernel == "cubic" ? Kernel::cubic_spline
                   : kernel == "cpdi"  ? Kernel::cpdi
                                       : Kernel::quadratic_spline;
  const Transfer t = transfer == "apic"   ? Transfer::apic
                     : transfer == "fmpm" ? Transfer::fmpm
                     : transfer == "flip" ? Transfer::flip
                                          : Transfer::blend;
  const std::string order = argc > 7 ? argv[7] : "USL-";
  return dim == "2" ? run<2>(k, t, order, cells, steps) : run<3>(k, t, order, cells, steps);
}
