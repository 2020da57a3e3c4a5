// SPDX-License-Identifier: MIT
/// Rigid bodies whose velocity the model prescribes.
#pragma once

#include "base/ranks.hpp"
#include "solver/distribution/distribution.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/state/travel.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

/// Bodies of rigid particles. Bodies in contact with others have a velocity field of their own. All other rigid bodies
/// prescribe the velocities of all fields at the nodes around them, in the directions that the material controls.
template <int Dim>
class RigidBodies {
 public:
  RigidBodies(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, const Exchanges<Dim>& exchanges,
              Distribution<Dim>& distribution, EnergyLedger& ledger);

  /// Finds the nodes that bodies without a field reach; to be called after every sort of the particles.
  void locate();
  /// Sets the particle velocities to the prescribed ones at the end of a step dt [time], and transfers those of bodies
  /// without a field to the nodes. A velocity that depends on the position is that at the middle of the way of the
  /// step, so that a rotation keeps all distances to third order in its angle per step. Throws SimulationError if the
  /// value of a velocity function is not finite.
  void set_velocities(double dt);
  /// Sets the prescribed nodal velocities before a strain update, and keeps the change of each velocity for
  /// impose_update().
  void impose();
  /// Sets the prescribed nodal velocities after the momentum update, and computes reactions, work and impulse.
  /// `after_impose`: impose() was called earlier in the step.
  void impose_update(double dt, bool after_impose);
  /// Moves the particles over a time dt, turns their domains, and adds their displacements to `travel`.
  void move(double dt, Travel& travel);
  /// Force of each rigid body on the material in the last step, in the order of the bodies [force].
  const std::vector<Vec3>& reactions() const { return reactions_; }

 private:
  // The nodes that a body without a field reaches, with the velocities that it prescribes there for all fields.
  struct PrescribedNodes {
    BlockMap<Dim> map;
    AlignedVector<PrescribedNode> nodes;
  };

  template <class F>
  void each_prescribed(F&& f);
  Vec3 wanted(const MaterialSpec& spec, const Vec3& position, const Vec3& otherwise, double dt) const;
  void deform(Body<Dim>& body, double dt);
  const double* mirror_image(const Field<Dim>& field, std::size_t rigid, std::size_t node, int axis) const;

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  const Exchanges<Dim>& exchanges_;
  Distribution<Dim>& distribution_;
  EnergyLedger& ledger_;
  std::vector<Vec3> reactions_;
  SumList sums_;                             // of a step
  std::vector<PrescribedNodes> prescribed_;  ///< per rigid body; empty for bodies with a field
  std::vector<double> changes_;              ///< of nodal velocities by impose(), in the order of each_prescribed()
  std::vector<bool> varies_;                 ///< per rigid body: whether its velocity depends on the position
};

}  // namespace tribo
