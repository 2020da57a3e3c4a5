// SPDX-License-Identifier: MIT
/// Contact impulses that act on faces between the nodes, not on single nodes.
///
/// If each node has one common velocity for the two fields in contact, the layers of nodes on both sides of the face
/// move as one. Then no strain can differ between these layers, and none can exist next to a rigid body, so that the
/// stress in the cells at the face is wrong (20 per cent RMS for a block between platens). Here the contact law acts on
/// the velocity of each body at the face (FaceConstraints). The impulse acts on the nodes with the weights that their
/// velocities have in that of the face, so that it never adds energy, wherever the face lies between the nodes. In
/// return, all nodes must be solved together, and the numerical damping of nodes that move as one is lost.
#pragma once

#include "solver/contact/face_constraints.hpp"
#include "solver/contact/row_islands.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tribo {

/// Finds the impulses of all pairs with faces so that each obeys its law at its face.
///
/// The iteration starts with the impulses of the last step. Jacobi sweeps spread the pressure evenly over pairs that
/// share nodes, Gauss-Seidel sweeps converge. The few pairs that share nodes with each other and with no others, as
/// those on a grid line normal to a plane face, form an island: it is solved by itself with the matrix of its masses,
/// so that the sweeps do not pass over nodal velocities. The other pairs of a block of nodes are solved one after the
/// other; blocks so far apart that their pairs share no nodes have the same colour and are solved in parallel. The
/// order of the sums does not depend on the number of threads.
template <int Dim>
class FaceSolver {
 public:
  explicit FaceSolver(System<Dim>& system) : system_(system), constraints_(system) {}

  /// Takes over all pairs of the nodes at which some pair has a face, and sets ContactNode::solved_on_faces. The pairs
  /// must stay where they are in memory until the next set_up().
  void set_up(ContactNodes<Dim>& contacts, const Exchanges<Dim>& exchanges);

  /// Applies the laws to the present velocities. In the corrector the accelerations change accordingly. `dt`: step.
  void apply(double dt, ContactPass pass);
  /// Subtracts the velocity changes of the last predictor.
  void remove();
  /// Applies the laws to the velocities that follow from the increments in Field::filter; an increment becomes the
  /// change of velocity that contact then makes: see Contact::constrain_increments.
  void constrain_increments(ContactPass pass);
  /// Sets ContactPair::final_velocity to that of the present velocities of the nodes, or of the filter.
  void find_velocities(bool of_filter);

 private:
  // What the sweeps read of a term: they pass over all of them many times, so it is small.
  struct Weight {
    double weight;
    double over_mass;  // weight times the inverse mass of the node, times the ownership of the node of the pair
    std::uint32_t velocity;
    ComponentSigns signs;
  };
  // What the sweeps read and write of a constraint, apart from its pair for the same reason.
  struct Row {
    ContactPair* pair;
    const ContactLaw* law;
    double size_before;        // squared impulse of the last step
    std::uint32_t first, end;  // in weights_
    bool active;
    bool next_to_plane;  // some weights have signs
    bool in_island;
    Hold hold;  // what its faces keep in the present pass
    double effective_mass, lumped_mass;
    Vec3 trial_velocity;  // relative velocity without contact
    Vec3 impulse;
    Vec3 impulse_change;  // of this sweep
    ContactState state;
    ContactResponse response;
    bool is_swept() const { return active && !in_island; }
  };
  // Changes of nodal velocities. With a fourth component, which is zero, they are one vector of the processor.
  using Changes = std::vector<Eigen::Vector4d>;
  // Squared sums of the impulses of a group in a sweep.
  struct Change {
    double change = 0.0, size = 0.0;
    void add(const Row& row) {
      change += row.impulse_change.squaredNorm();
      size += std::max(row.impulse.squaredNorm(), row.size_before);
    }
    // Whether the impulses have hardly changed.
    bool is_small() const {
      constexpr double tolerance = 1e-8;  // relative
      return change <= tolerance * tolerance * size;
    }
  };

  template <class Value>
  Vec3 weighted_sum(const Row& row, Value&& value) const;
  template <class F>
  void each_group(bool backward, F&& f);
  template <class F>
  void each_island(F&& f);
  template <class F>
  void each_row(F&& f);
  template <class F>
  void each_velocity(const Changes& changes, F&& f);
  Vec3 velocity_at_face(const Row& row) const;
  void find_islands();
  void find_couplings(std::size_t island);
  void solve_island(std::size_t island);
  void update_impulse(Row& row, const Vec3& velocity, double mass);
  void distribute(const Row& row, const Vec3& impulse);
  void begin_row(Row& row, double dt, ContactPass pass);
  void sweep_all_at_once();
  bool sweep_one_by_one(bool backward);
  void sweep_rows();
  void solve(ContactPass pass);

  System<Dim>& system_;
  FaceConstraints<Dim> constraints_;
  std::vector<Row> rows_;  // of the constraints, in the same order
  std::vector<Weight> weights_;
  RowIslands islands_;  // of the rows, with the nodal velocities as unknowns
  // Per island of n rows, from first_coupling_ on, n x n: by how much the relative velocity of a row decreases, per
  // component, with the impulse of another one.
  std::vector<Vec3> couplings_;
  std::vector<std::size_t> first_coupling_;
  bool has_swept_rows_ = false;        // some active rows are in no island
  Changes changes_;                    // of the nodal velocities, by contact
  Changes start_changes_;              // those of the last predictor
  std::vector<Change> group_changes_;  // per group
};

}  // namespace tribo
