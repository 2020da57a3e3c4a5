// SPDX-License-Identifier: MIT
/// Contact impulses that act on faces between the nodes, not on single nodes.
///
/// If each node has one common velocity for the two fields in contact, the layers of nodes on both sides of the face
/// move as one. Then no strain can differ between these layers, and none can exist next to a rigid body, so that the
/// stress in the cells at the face is wrong (20 per cent RMS for a block between platens). Here the contact law acts on
/// the velocity of each body at the face: the mean of the velocity of the node and of that at its mirror image in the
/// face. The impulse acts on the node and on the nodes around the image with the same weights, so that it never adds
/// energy, wherever the face lies between the nodes. In return, all nodes must be solved together, and the numerical
/// damping of nodes that move as one is lost.
#pragma once

#include "grid/nodes.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// Finds the impulses of all pairs that were added so that each obeys its law at its face.
template <int Dim>
class FaceSolver {
 public:
  explicit FaceSolver(System<Dim>& system) : system_(system) {}

  /// Removes all pairs; to be called before the pairs of a step are added.
  void clear();
  /// Adds a pair of the contact node at `index`; pair.a and pair.b are positions in `members`. `has_face`: the face
  /// position and the normal of the pair are known; else its law acts on the velocities of the node itself. The pair
  /// must stay where it is in memory until clear().
  void add(ContactPair& pair, std::span<const ContactMember> members, const Index<Dim>& index, bool has_face);

  /// Applies the laws to the present velocities. In the corrector the accelerations change accordingly. `dt`: step.
  void apply(double dt, ContactPass pass);
  /// Subtracts the velocity changes of the last apply().
  void remove();
  /// Applies the laws to the velocities that follow from the increments in Field::filter; an increment becomes the
  /// change of velocity that contact then makes: see Contact::constrain_increments.
  void constrain_increments(ContactPass pass);

 private:
  // A nodal velocity with its weight in the relative velocity of a pair.
  struct Term {
    std::size_t dof;  // position in dofs_
    double weight;
  };
  // A pair and its relative velocity at the face as a weighted sum of nodal velocities.
  struct Constraint {
    ContactPair* pair;
    std::size_t first_term, end_term;
    Vec3 rigid_velocity = Vec3::Zero();  // contribution of a field with prescribed velocity
    Vec3 trial_velocity = Vec3::Zero();  // relative velocity without contact
    double effective_mass = 0.0;         // impulse over change of relative velocity if no other pair acts
    double lumped_mass = 0.0;            // smaller: also stable if all pairs that share nodes act at once
    Vec3 impulse_change = Vec3::Zero();  // of this sweep
  };
  // The velocity of one field at one node.
  struct NodalVelocity {
    std::size_t field;
    std::int64_t node;
    double inverse_mass;
    Vec3 change = Vec3::Zero();  // by contact
  };

  std::size_t dof(std::size_t field, std::int64_t node);
  void add_image(const ContactPair& pair, const ContactMember& member, const Index<Dim>& index);
  template <class Value>
  Vec3 weighted_sum(const Constraint& c, Value&& value) const;
  void update_impulse(Constraint& c, double mass, ContactPass pass);
  void distribute(const Constraint& c, const Vec3& impulse);
  static bool is_inactive(const Constraint& c, ContactPass pass);
  void solve(ContactPass pass);

  System<Dim>& system_;
  std::vector<Constraint> constraints_;
  std::vector<Term> terms_;
  std::vector<NodalVelocity> dofs_;
  std::vector<std::vector<int>> dof_of_;  // per field and node: position in dofs_, or -1
};

}  // namespace tribo
