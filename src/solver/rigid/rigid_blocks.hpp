// SPDX-License-Identifier: MIT
/// Rigid blocks among the matter in the grid: they prescribe the velocity of their nodes, and contact exerts forces on
/// them.
#pragma once

#include "solver/contact/contact.hpp"
#include "solver/state/system.hpp"

namespace tribo {

template <int Dim>
class RigidBlocks {
 public:
  explicit RigidBlocks(System<Dim>& system) : system_(system) {}

  bool active() const { return system_.blocks != nullptr; }
  /// Gives the particles of blocks the velocity of their place.
  void set_particle_velocities();
  /// Gives the nodes with mass of a block's field the momentum of their own place, exactly.
  void set_nodal_momentum(const Body<Dim>& body);
  /// Takes what contact did in a step of dt. Momentum is kept to round-off: blocks get the opposite of what the matter
  /// got, at the nodes where it acted. Throws SimulationError if a block is so light against the matter at the nodes it
  /// touches that the exchange would be unstable.
  void take_contact_forces(const std::vector<RigidExchange>& exchanges, double dt);
  /// Moves blocks and their particles, in shorter steps if the contacts between blocks need them. Returns how far the
  /// fastest particle went [cells].
  double move(double dt);

 private:
  void check_stability(const Body<Dim>& body, const RigidExchange& exchange) const;

  System<Dim>& system_;
  std::vector<Mat3> before_;  ///< scratch: rotations at the start of the step
};

}  // namespace tribo
