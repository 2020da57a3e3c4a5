// SPDX-License-Identifier: MIT
/// Tractions on the faces of particles.
#pragma once

#include "solver/cracks/cracks.hpp"
#include "solver/loads/loaded.hpp"
#include "solver/state/energy_ledger.hpp"

namespace tribo {

/// The tractions that the model prescribes on faces of particles.
template <int Dim>
class Tractions {
 public:
  Tractions(const Model& model, System<Dim>& system, const Exchanges<Dim>& exchanges, const Cracks<Dim>& cracks,
            EnergyLedger& ledger);

  /// Adds the forces of all tractions to the nodal forces.
  void apply();
  /// Adds work and impulse of the step to the ledger. The work is that at the velocities of NodalWork, which explains
  /// `filtered` and `strain_filtered`: record() unless the velocities are extrapolated again, otherwise record_start()
  /// and record_end().
  void record(double dt, bool filtered);
  void record_start(double dt, bool filtered);
  void record_end(double dt, bool filtered, bool strain_filtered);
  /// With `filtered` velocities: to be called after the update of the particle velocities.
  void record_change_of_velocities(double dt);

 private:
  void apply(const ParticleCondition& condition, Body<Dim>& body, std::size_t particle);

  // Whether the velocities that strain the particles at the start of the step are known.
  bool knows_start() const { return model_.scheme.order == UpdateOrder::usavg; }
  template <class F>
  void add_work(double dt, F&& velocity);
  void add_impulse(double dt);

  struct NodalForce {
    std::size_t field;
    std::int64_t node;
    Vec<Dim> force;
  };

  struct LoadedParticle {
    const Body<Dim>* body;
    std::size_t particle;
    Vec<Dim> force, velocity;  // velocity before the step
  };

  const Model& model_;
  System<Dim>& system_;
  const Exchanges<Dim>& exchanges_;
  const Cracks<Dim>& cracks_;
  EnergyLedger& ledger_;
  bool any_;
  std::vector<NodalForce> forces_;         // forces of the tractions in this step on own nodes
  std::vector<LoadedParticle> particles_;  // and the own particles on whose faces they act
};

}  // namespace tribo
