// SPDX-License-Identifier: MIT
/// Forces on particles.
#pragma once

#include "solver/loads/loaded.hpp"
#include "solver/state/energy_ledger.hpp"

namespace tribo {

/// Point loads, and forces per mass that are functions of the particles' places.
template <int Dim>
class ParticleLoads {
 public:
  /// Marks the particles that carry loads, tractions or heat fluxes. Throws InputError for a condition that selects no
  /// particle.
  ParticleLoads(const Model& model, System<Dim>& system, EnergyLedger& ledger)
      : model_(model), system_(system), ledger_(ledger), factor_(find_loaded(model, system)) {}

  /// Sets the load column of all particles for a step of dt, which the next scatter adds to the forces.
  void apply(double dt);
  /// Adds impulse, and work with the present velocities of the particles, over a time dt to the ledger. Called with
  /// half a step at its start and with the other half at its end, this is accurate to second order.
  void record(double dt);

 private:
  Vec3 force_on(Body<Dim>& body, std::size_t particle, double dt) const;

  const Model& model_;
  System<Dim>& system_;
  EnergyLedger& ledger_;
  std::vector<double> factor_;           // per condition: 1, or one over the number of particles for net loads
  std::vector<WorkAndImpulse> partial_;  // per piece of the loop over particles
};

}  // namespace tribo
