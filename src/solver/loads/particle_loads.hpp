// SPDX-License-Identifier: MIT
/// Forces on particles.
#pragma once

#include "solver/loads/loaded.hpp"
#include "solver/state/energy_ledger.hpp"

namespace tribo {

/// Point loads on particles, and forces per mass that are functions of the positions of particles.
template <int Dim>
class ParticleLoads {
 public:
  /// Marks the particles with loads, tractions or heat fluxes. Throws InputError if a condition selects no particle.
  ParticleLoads(const Model& model, System<Dim>& system, EnergyLedger& ledger)
      : model_(model), system_(system), ledger_(ledger), factor_(find_loaded(model, system)) {}

  /// Computes the load column of all particles for a step dt, and records the first half of their work. The next
  /// scatter adds the loads to the nodal forces.
  void apply(double dt);
  /// Adds the impulse of the loads over a time dt, and their work with the current particle velocities, to the ledger.
  /// Recording half a step at its start and half a step at its end is accurate to second order.
  void record(double dt);
  /// At the begin of the stage of the model: chooses the particles, see mark_loaded(). Returns the places of conditions
  /// without a particle.
  std::vector<Origin> choose() {
    std::vector<Origin> none;
    factor_ = mark_loaded(model_, system_, none);
    return none;
  }

  /// Saves and restores the factors. Which particles they belong to is a column of the particles.
  friend void archive(Archive& a, ParticleLoads& loads) {
    auto& [model, system, ledger, factor, partial, pieces, positions, accelerations] = loads;
    a.version(1);
    a.resizable("factor", factor);
    factor.resize(model.particle_conditions.size(), 1.0);
    std::int64_t of_program = 1;  // a run without the program cannot continue from this state
    if (model.body_force.of_program) a("loads_of_program", of_program);
  }

 private:
  Vec3 force_on(Body<Dim>& body, std::size_t particle, double dt) const;
  void add_loads_of_program();

  const Model& model_;
  System<Dim>& system_;
  EnergyLedger& ledger_;
  std::vector<double> factor_;           // per condition: 1, or one over the number of particles for net loads
  std::vector<WorkAndImpulse> partial_;  // scratch: sums over ranges of particles
  std::vector<Bin> pieces_;              // scratch
  std::vector<double> positions_, accelerations_;  // scratch: of all particles, for the loads of a program
};

}  // namespace tribo
