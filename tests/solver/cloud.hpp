// SPDX-License-Identifier: MIT
/// Random clouds of particles in a system, for tests of the transfers and the step without any input file.
#pragma once

#include <catch2/catch.hpp>

#include "contact/contact_cases.hpp"
#include "solver/build.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <functional>
#include <random>

namespace tribo::test {

inline std::shared_ptr<const Material> elastic(double density = 1000, double young = 1e6, double poisson = 0.3) {
  Statement statement;
  const auto add = [&](const char* name, double value) {
    Statement child;
    child.name = name;
    child.text = std::to_string(value);
    statement.children.push_back(child);
  };
  add("rho", density), add("E", young), add("nu", poisson);
  Problems problems;
  std::shared_ptr<const Material> law = materials().find("LinearElastic")->make(statement, {}, Units{}, problems);
  problems.raise();
  return law;
}

/// A model with a grid of `cells` unit cells per axis from 0 and one elastic material.
template <int Dim>
Model grid_model(Kernel kernel, Transfer transfer, UpdateOrder order = UpdateOrder::usl, bool again = false,
                 int cells = 24) {
  Model model;
  model.analysis = Dim == 2 ? Analysis::plane_strain : Analysis::solid;
  model.scheme.kernel = kernel;
  model.scheme.transfer = transfer;
  model.scheme.order = order;
  model.scheme.extrapolate_again = again;
  for (std::size_t d = 0; d < Dim; ++d) model.grid.high[d] = cells, model.grid.cells[d] = cells;
  MaterialSpec spec;
  spec.name = "block";
  spec.law = elastic();
  model.materials.push_back(spec);
  return model;
}

/// Particles on a regular lattice, n per cell and axis, in the cells [from, to) along every axis, moved by up to
/// `jitter`.
template <int Dim>
std::vector<Seed> lattice_seeds(const Model& model, int from, int to, int n = 2, double jitter = 0.0,
                                unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-jitter, jitter);
  std::vector<Seed> seeds;
  const int per_axis = (to - from) * n;
  for (int k = 0; k < (Dim == 3 ? per_axis : 1); ++k)
    for (int j = 0; j < per_axis; ++j)
      for (int i = 0; i < per_axis; ++i) {
        Seed s;
        const int index[3] = {i, j, k};
        for (int d = 0; d < Dim; ++d) s.x[d] = from + (index[d] + 0.5) / n + noise(random);
        s.half_size.template head<Dim>().setConstant(0.5 / n);
        s.volume = std::pow(1.0 / n, Dim);
        s.mass = model.materials[0].law->density() * s.volume;
        seeds.push_back(s);
      }
  return seeds;
}

/// Velocities of all particles from a function of position.
template <int Dim>
void set_velocity(Body<Dim>& body, const std::function<Vec<Dim>(const Vec<Dim>&)>& f) {
  const auto v = body.particles.v();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<Dim> value = f(body.particles.position(i));
    for (std::size_t d = 0; d < Dim; ++d) v[d][i] = value[static_cast<Eigen::Index>(d)];
  }
}

/// Sorts the particles and makes the blocks exist, as the first step would.
template <int Dim>
void settle(System<Dim>& system) {
  std::vector<std::int64_t> occupied;
  for (auto& body : system.bodies) {
    REQUIRE(body.bins.sort(system.lattice, body.particles) == -1);
    for (const Bin& bin : body.bins.list()) occupied.push_back(bin.block);
    body.refresh();
    if (body.domain)
      for (std::size_t k = 0; k < Dim * Dim; ++k)
        std::copy_n(body.particles.F()[k], body.particles.size(), body.particles[body.domain][k]);
  }
  auto& field = system.fields[0];
  field.map.rebuild(occupied);
  field.nodes.assign(static_cast<std::size_t>(field.map.node_count()), Node{});
}

inline std::string name(Kernel kernel) {
  switch (kernel) {
    case Kernel::linear:
      return "linear";
    case Kernel::gimp:
      return "uGIMP";
    case Kernel::quadratic_spline:
      return "quadratic";
    case Kernel::cubic_spline:
      return "cubic";
    case Kernel::cpdi:
      return "CPDI";
  }
  return "";
}

inline constexpr std::array all_kernels{Kernel::linear, Kernel::gimp, Kernel::quadratic_spline, Kernel::cubic_spline,
                                        Kernel::cpdi};

/// Adds a rigid material in frictionless contact whose velocity components are the functions vx and vy.
inline void add_rigid_tool(Model& model, const char* vx, const char* vy) {
  model.contact.active = true;
  model.contact.default_law = make_law("CoulombFriction", {{"coeff", "0"}});
  MaterialSpec tool = model.materials[0];
  Problems problems;
  tool.law = materials().find("RigidContact")->make({}, {}, Units{}, problems);
  problems.raise();
  tool.rigid_contact = true;
  tool.rigid_velocity[0].emplace(vx, Origin{}), tool.rigid_velocity[1].emplace(vy, Origin{});
  model.materials.push_back(tool);
}

}  // namespace tribo::test
