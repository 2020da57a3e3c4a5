// SPDX-License-Identifier: MIT
/// Accelerations that the user prescribes as functions of position and time.
#pragma once

#include "solver/exchange/node_sums.hpp"

namespace tribo {

template <int Dim>
class BodyForces {
 public:
  BodyForces(const Model& model, System<Dim>& system, const Exchanges<Dim>& exchanges, EnergyLedger& ledger)
      : force_(model.body_force), system_(system), sum_(system, exchanges), ledger_(ledger) {}

  /// Value of the functions at a place, for the step that begins now [length/time^2]. Constant gravity is not included.
  Vec3 at(const Vec<Dim>& place, double dt) const;
  /// Adds the functions to the accelerations and velocities of the nodes of field f.
  void apply(std::size_t f, double dt);
  /// Adds work and impulse of the step to the ledger, with the velocities at mid step.
  void record(double dt);

 private:
  bool active() const { return force_.function[0] || force_.function[1] || force_.function[2]; }

  const BodyForce& force_;
  System<Dim>& system_;
  NodeSums<Dim> sum_;
  EnergyLedger& ledger_;
};

}  // namespace tribo
