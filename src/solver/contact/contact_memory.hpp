// SPDX-License-Identifier: MIT
/// The slip and the bonds of contact faces, which the particles near them keep.
#pragma once

#include "solver/contact/contact_particles.hpp"

namespace tribo {

/// Transfers slip and bonds between contact nodes and particles (columns Body::contact_slip).
template <int Dim>
class ContactMemory {
 public:
  /// `cloud`: the particles around the contact nodes of the step; `bodies`: those of the cloud.
  ContactMemory(const System<Dim>& system, const ContactSearch<Dim>& search, const ParticleCloud<Dim>& cloud,
                const std::vector<Body<Dim>*>& bodies)
      : system_(system), search_(search), cloud_(cloud), bodies_(bodies), h_(system.lattice.spacing.maxCoeff()) {}

  /// Sets slip and bond in the state of a pair to those of the particles near the node. Faces that touch at the very
  /// start of the run are bonded. `near`: the particles around the node, its sides for the normal of the pair.
  void read(const ContactNode<Dim>& node, ContactPair& pair, NearParticles<Dim>& near) const;
  /// Updates slip and bonds of all particles of the cloud from the responses of the last momentum update.
  void update() const;

 private:
  bool domains_touch(const ContactPair& pair, NearParticles<Dim>& near) const;

  const System<Dim>& system_;
  const ContactSearch<Dim>& search_;
  const ParticleCloud<Dim>& cloud_;
  const std::vector<Body<Dim>*>& bodies_;
  double h_;  // cell size [length]
};

}  // namespace tribo
