// SPDX-License-Identifier: MIT
/// Rigid blocks in contact with deformable bodies: a block prescribes the velocities of its nodes, and the contact
/// impulses act on the block.
#pragma once

#include "solver/contact/contact.hpp"
#include "solver/state/system.hpp"
#include "solver/state/travel.hpp"

namespace tribo {

/// Couples rigid blocks to the velocity fields of the grid.
template <int Dim>
class RigidBlocks {
 public:
  explicit RigidBlocks(System<Dim>& system) : system_(system) {}

  bool active() const { return system_.blocks != nullptr; }
  /// Sets the particle velocities of all blocks to the rigid-body velocity at their positions.
  void set_particle_velocities();
  /// Sets the momentum of the nodes with mass in the field of a block to the rigid-body velocity at the node times the
  /// nodal mass.
  void set_nodal_momentum(const Body<Dim>& body);
  /// Sets the forces and moments on the blocks from the contact impulses of a step dt [time]. The opposite of each
  /// impulse on a deformable body acts on the block at the same node, so momentum is conserved to round-off. Throws
  /// SimulationError if the mass of a block is so small, compared with the nodal masses in contact with it, that the
  /// exchange of momentum would be unstable.
  void take_contact_forces(const std::vector<RigidExchange>& exchanges, double dt);
  /// Moves the blocks over a time dt, in shorter steps if contacts between blocks require them. Throws SimulationError
  /// if the motion is not finite.
  void advance(double dt);
  /// Mean velocities of the blocks in the last advance(): the product with the forces and moments of the grid and dt is
  /// the work that the blocks have received from the grid.
  const std::vector<BlockMean>& means() const { return means_; }
  /// Moves the particles of the blocks to their present positions, and adds their displacements to `travel`.
  void move_particles(Travel& travel);

 private:
  void check_stability(const Body<Dim>& body, const RigidExchange& exchange) const;

  System<Dim>& system_;
  std::vector<Mat3> before_;      ///< scratch: rotations at the start of the step
  std::vector<BlockMean> means_;  ///< of all blocks and platens
};

}  // namespace tribo
