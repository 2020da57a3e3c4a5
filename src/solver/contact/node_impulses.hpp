// SPDX-License-Identifier: MIT
/// Contact impulses that act on single nodes, each node independently of the others.
#pragma once

#include "solver/contact/contact_nodes.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Applies the contact laws to the nodal velocities, node by node. Nodes that FaceSolver treats are left out.
template <int Dim>
class NodeImpulses {
 public:
  /// `contacts`: the contact nodes of the step, whose impulses and responses are set.
  NodeImpulses(System<Dim>& system, ContactNodes<Dim>& contacts) : system_(system), contacts_(contacts) {}

  /// Applies the laws to the present velocities. In the corrector the accelerations change accordingly. `dt`: step.
  void apply(double dt, ContactPass pass);
  /// Subtracts the velocity changes of the last apply(), which must have been the predictor.
  void remove();
  /// Applies the laws to the velocities that follow from the increments in Field::filter; an increment becomes the
  /// change of velocity that contact then makes: see Contact::constrain_increments.
  void constrain_increments(ContactPass pass);

 private:
  void change_at_start(const ContactNode<Dim>& node, double sign);

  System<Dim>& system_;
  ContactNodes<Dim>& contacts_;
};

}  // namespace tribo
