// SPDX-License-Identifier: MIT
/// Contact impulses that act on faces between the nodes, not on single nodes.
///
/// If each node has one common velocity for the two fields in contact, the layers of nodes on both sides of the face
/// move as one. Then no strain can differ between these layers, and none can exist next to a rigid body, so that the
/// stress in the cells at the face is wrong (20 per cent RMS for a block between platens). Here the contact law acts on
/// the velocity of each body at the face: the mean of the velocity of the node and of that at its mirror image in the
/// face. Where a body reaches only some of the nodes around the image, the weights are such that their mean position is
/// on the face all the same, or else the stress next to the face would be wrong by up to its own size. The impulse acts
/// on the node and on the nodes around the image with the same weights, so that it never adds energy, wherever the face
/// lies between the nodes. In return, all nodes must be solved together, and the numerical damping of nodes that move
/// as one is lost.
#pragma once

#include "grid/nodes.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/state/system.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tribo {

/// Finds the impulses of all pairs with faces so that each obeys its law at its face.
///
/// The iteration starts with the impulses of the last step. Jacobi sweeps spread the pressure evenly over pairs that
/// share nodes, Gauss-Seidel sweeps converge. The pairs of a block of nodes are solved one after the other; blocks so
/// far apart that their pairs share no nodes have the same colour and are solved in parallel. The order of the sums
/// does not depend on the number of threads.
template <int Dim>
class FaceSolver {
 public:
  explicit FaceSolver(System<Dim>& system) : system_(system) {}

  /// Takes over all pairs of the nodes at which some pair has a face, and sets ContactNode::solved_on_faces. The pairs
  /// must stay where they are in memory until the next set_up().
  void set_up(ContactNodes<Dim>& contacts);

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
    std::uint32_t field;
    std::uint32_t dof;  // position in dofs_
    std::int64_t node;
    double weight;
  };
  // Of each side the velocity of the node, and those of the nodes of the cell that contains its image.
  static constexpr std::size_t max_terms = 2 * (1 + (1 << Dim));
  // A pair and its relative velocity at the face as a weighted sum of nodal velocities.
  struct Constraint {
    ContactPair* pair = nullptr;
    const ContactNode<Dim>* node = nullptr;
    bool has_face = false;  // else the law acts on the velocities of the node itself
    std::size_t term_count = 0;
    std::array<Term, max_terms> terms;
    std::array<double, 2> mean_mass{};   // of the nodes of each body, weighted
    Vec3 trial_velocity = Vec3::Zero();  // relative velocity without contact
    double effective_mass = 0.0;         // impulse over change of relative velocity if no other pair acts
    double lumped_mass = 0.0;            // smaller: also stable if all pairs that share nodes act at once
    Vec3 impulse_change = Vec3::Zero();  // of this sweep
  };
  // The velocity of one field at one node.
  struct NodalVelocity {
    std::uint32_t field;
    std::int64_t node;
    double inverse_mass;
    double mean_mass = 0.0;      // the largest mean of the nodes of a constraint with this one
    double start_share = 1.0;    // of the change that is made at the start of the step
    Vec3 change = Vec3::Zero();  // by contact
  };
  // The constraints of the contact nodes of one block.
  struct Group {
    std::size_t first, end;           // in constraints_
    int colour;                       // groups of the same colour share no nodes
    double change = 0.0, size = 0.0;  // squared sums of the impulses in a sweep
  };

  static bool is_inactive(const Constraint& c);
  void list_constraints(ContactNodes<Dim>& contacts);
  void find_terms(Constraint& c, std::span<const ContactMember> members) const;
  double add_face_terms(Constraint& c, const ContactMember& member, double sign) const;
  bool add_image_terms(Constraint& c, const Term& of, std::span<double> distances) const;
  void number_velocities();
  void find_masses(Constraint& c) const;
  template <class Value>
  Vec3 weighted_sum(const Constraint& c, Value&& value) const;
  template <class F>
  void each_group(bool backward, F&& f);
  template <class F>
  void each_constraint(F&& f);
  template <class F>
  void each_velocity(F&& f);
  void update_impulse(Constraint& c, double mass, ContactPass pass);
  void distribute(const Constraint& c, const Vec3& impulse);
  void distribute_at_start(const Constraint& c, const Vec3& impulse);
  void solve(ContactPass pass);

  System<Dim>& system_;
  std::vector<Constraint> constraints_;
  std::vector<Group> groups_;             // sorted by colour
  std::vector<std::size_t> colour_ends_;  // per colour that occurs: end of its groups
  std::vector<NodalVelocity> dofs_;
  std::vector<std::vector<std::int32_t>> dof_of_;  // per field and node: position in dofs_, or -1
};

}  // namespace tribo
