// SPDX-License-Identifier: MIT
/// Volumes and volume gradients of the bodies at the nodes around contact nodes.
#pragma once

#include "solver/contact/contact_nodes.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/transfer/transfer.hpp"

#include <vector>

namespace tribo {

/// Scatters the volumes of the particles to the layer Field::volumes of their fields.
template <int Dim>
class NodalVolumes {
 public:
  NodalVolumes(System<Dim>& system, const Transfers<Dim>& transfers) : system_(system), transfers_(transfers) {}

  /// For each field and each contact node whose faces must be found: the volume sum_p V_p w_Ip (in place of the mass),
  /// its first moment (in place of the velocity), and the volume gradient sum_p V_p grad w_Ip (in place of the
  /// acceleration). The gradient is the integral of the shape function over the surface times the outward normal.
  /// `bodies`: those with a velocity field; `exchanges`: one for each field.
  void scatter(const ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies,
               const Exchanges<Dim>& exchanges);

 private:
  void mark_blocks(const ContactNodes<Dim>& contacts);

  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  std::vector<std::vector<Body<Dim>*>> bodies_of_;  // per field
  std::vector<char> near_;     // per block of the lattice: 1 if the particles of its bin may contribute
  std::vector<char> reached_;  // 1 if such particles may contribute to its nodes
};

}  // namespace tribo
