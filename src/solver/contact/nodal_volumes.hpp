// SPDX-License-Identifier: MIT
/// Volumes and volume gradients of the bodies at contact nodes.
#pragma once

#include "solver/contact/contact_nodes.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/transfer/transfer.hpp"

#include <array>
#include <vector>

namespace tribo {

/// Scatters the volumes of the particles to the nodes, and gives the sums to the members of contact nodes.
///
/// The nodal arrays of a scatter are needed for the bodies of one velocity field at a time only. Each thread has one
/// set of them, so that many fields need no more memory than a few.
template <int Dim>
class NodalVolumes {
 public:
  NodalVolumes(System<Dim>& system, const Transfers<Dim>& transfers) : system_(system), transfers_(transfers) {}

  /// For each member of a contact node whose faces must be found: the volume sum_p V_p w_Ip (in place of the mass), its
  /// first moment (in place of the velocity), and the volume gradient sum_p V_p grad w_Ip (in place of the
  /// acceleration). The gradient is the integral of the shape function over the surface times the outward normal. Sets
  /// ContactMember::volumes, which is valid until the next call. `bodies`: those with a velocity field; `exchanges`:
  /// one for each field.
  void scatter(ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies, const Exchanges<Dim>& exchanges);

 private:
  // The nodes of the fields of a body: of its own one and of those for the sides 1, 2 and 3 of cracks.
  using Layers = std::array<AlignedVector<VolumeNode>, 4>;
  // A member of a contact node, and where its values are stored.
  struct Place {
    std::size_t node;   // position in the nodal arrays of the field
    std::size_t value;  // position in values_
  };

  void mark_blocks(const ContactNodes<Dim>& contacts);
  void list_members(ContactNodes<Dim>& contacts);
  void scatter_field(std::size_t field, Layers& layers, const Exchanges<Dim>& exchanges);

  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  AlignedVector<VolumeNode> values_;                // of the members of contact nodes
  std::vector<std::vector<Body<Dim>*>> bodies_of_;  // per field
  std::vector<std::vector<Place>> members_of_;      // per field
  std::vector<Layers> layers_;                      // per thread
  BlockFlags<Dim> near_{0};                         // the particles of the bin of the block may contribute
  BlockFlags<Dim> reached_{0};                      // such particles may contribute to its nodes
};

}  // namespace tribo
