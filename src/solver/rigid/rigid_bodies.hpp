// SPDX-License-Identifier: MIT
/// Rigid bodies whose velocity the model prescribes.
#pragma once

#include "solver/exchange/exchange.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

/// Particles of rigid materials. Bodies that others touch by contact have a velocity field of their own. The other ones
/// prescribe the velocity of all fields at the nodes around them, in the directions that the material controls.
template <int Dim>
class RigidBodies {
 public:
  RigidBodies(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, const Exchanges<Dim>& exchanges,
              EnergyLedger& ledger)
      : model_(model), system_(system), transfers_(transfers), exchanges_(exchanges), ledger_(ledger) {}

  /// Gives the particles their prescribed velocities at the end of a step of dt, and the nodes those of the bodies
  /// without a field. Throws SimulationError if a velocity function is not a number.
  void set_velocities(double dt);
  /// Sets the prescribed velocities of nodes before a strain update, and stores by how much each velocity changed.
  void impose();
  /// Sets them after the momentum update; reactions, work and impulse follow. `after_impose`: impose() was called
  /// earlier in the step.
  void impose_update(double dt, bool after_impose);
  /// Moves the particles and returns the largest displacement along an axis [cells].
  double move(double dt);
  /// Force of each rigid body on the material in the last step, in the order of the bodies [force].
  const std::vector<Vec3>& reactions() const { return reactions_; }

 private:
  template <class F>
  void each_prescribed(F&& f);
  const double* mirror_image(const Field<Dim>& field, std::size_t rigid, std::size_t node, int axis) const;

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  const Exchanges<Dim>& exchanges_;
  EnergyLedger& ledger_;
  std::vector<Vec3> reactions_;
};

}  // namespace tribo
