// SPDX-License-Identifier: MIT
/// Body forces: accelerations that the model prescribes as functions of position and time.
#pragma once

#include "solver/exchange/node_sums.hpp"

namespace tribo {

/// Applies the body forces to the nodes and records their work.
template <int Dim>
class BodyForces {
 public:
  BodyForces(const Model& model, System<Dim>& system, const Exchanges<Dim>& exchanges, EnergyLedger& ledger)
      : force_(model.body_force), system_(system), sum_(system, exchanges), ledger_(ledger) {}

  /// Acceleration at a position [length] for the step dt that begins at the current time [length/time^2]. Constant
  /// gravity is not included.
  Vec3 at(const Vec<Dim>& place, double dt) const;
  /// Adds the body forces to the nodal accelerations of field f, and their effect over the step dt to the nodal
  /// velocities.
  void apply(std::size_t f, double dt);
  /// Adds work and impulse of the step to the ledger. The work uses the nodal velocities at mid step.
  void record(double dt);

 private:
  bool active() const { return force_.function[0] || force_.function[1] || force_.function[2]; }

  const BodyForce& force_;
  System<Dim>& system_;
  NodeSums<Dim> sum_;
  EnergyLedger& ledger_;
};

}  // namespace tribo
