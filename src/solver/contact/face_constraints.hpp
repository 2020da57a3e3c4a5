// SPDX-License-Identifier: MIT
/// The relative velocities at faces as weighted sums of nodal velocities.
#pragma once

#include "grid/nodes.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/state/system.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tribo {

/// The velocity of one field at one node.
struct FaceVelocity {
  std::uint32_t field;
  std::int64_t node;
  double inverse_mass;  ///< of the part of the nodal mass that is inside the symmetry planes
};

/// The signs with which the components of a nodal velocity enter the velocity at a face. All are one, except next to
/// symmetry planes: those of a mirror image are -1 normal to the plane, and those of a node on the plane are 0.
class ComponentSigns {
 public:
  ComponentSigns() = default;
  /// Bit d of `reflected` and `held`: component d has the sign -1 or 0.
  ComponentSigns(int reflected, int held)
      : bits_(static_cast<std::uint32_t>(reflected & ~held) | static_cast<std::uint32_t>(held) << 3) {}

  bool all_one() const { return bits_ == 0; }
  double operator[](int d) const { return (bits_ >> (d + 3) & 1) != 0 ? 0.0 : (bits_ >> d & 1) != 0 ? -1.0 : 1.0; }
  /// A vector of three or four components with these signs.
  template <class Vector>
  Vector of(Vector v) const {
    for (int d = 0; d < 3; ++d) v[d] *= (*this)[d];
    return v;
  }

 private:
  std::uint32_t bits_ = 0;
};

/// A nodal velocity with its weight in the relative velocity of a pair.
struct FaceTerm {
  std::uint32_t field;
  std::uint32_t velocity;  ///< position in FaceConstraints::velocities()
  std::int64_t node;
  double weight;
  ComponentSigns signs;
};

/// A pair and its relative velocity at the face as a weighted sum of nodal velocities.
template <int Dim>
struct FaceConstraint {
  /// Of each side the nodes of the cells that contain two points.
  static constexpr std::size_t max_terms = 4 * (1 << Dim);

  ContactPair* pair = nullptr;
  const ContactNode<Dim>* node = nullptr;
  bool has_face = false;  ///< else the law acts on the velocities of the node itself
  std::size_t term_count = 0;
  std::array<FaceTerm, max_terms> all_terms;
  double effective_mass = 0.0;  ///< impulse over change of relative velocity if no other pair acts [mass]
  double lumped_mass = 0.0;     ///< smaller: also stable if all pairs that share nodes act at once [mass]

  /// Starts anew without terms, which a constraint of the step before may have.
  void begin(ContactPair& its_pair, const ContactNode<Dim>& its_node, bool face) {
    pair = &its_pair, node = &its_node, has_face = face;
    term_count = 0;
  }
  std::span<const FaceTerm> terms() const { return {all_terms.data(), term_count}; }
};

/// The constraints of the contact nodes of one block, as positions [first, end) in the list of all. Groups of the same
/// colour share no nodes.
struct FaceGroup {
  std::size_t first, end;
  int colour;
};

/// Finds the constraints of a step. The contact law acts on the velocity of each body at the face: the mean of the
/// velocity of the node and of that at its mirror image in the face. At a curved face, both points are moved along the
/// face to where the bodies meet first, as the gap is that of this place: otherwise nodes ahead of a body that rolls
/// stop it before it touches. Where a body reaches only some of the nodes around such a point, the weights are such
/// that their mean position is on the face all the same, or else the stress next to the face would be wrong by up to
/// its own size.
///
/// Nodes beyond a symmetry plane are replaced by their mirror images, so that the constraints are those of the whole
/// body. The impulse of a pair counts with the ownership of its node, as the nodal masses do.
template <int Dim>
class FaceConstraints {
 public:
  explicit FaceConstraints(System<Dim>& system) : system_(system) {}

  /// Takes over all pairs of the nodes at which some pair has a face, and sets ContactNode::solved_on_faces. The pairs
  /// must stay where they are in memory as long as the constraints are used.
  void find(ContactNodes<Dim>& contacts, const Exchanges<Dim>& exchanges);

  const std::vector<FaceConstraint<Dim>>& list() const { return constraints_; }
  const std::vector<FaceVelocity>& velocities() const { return velocities_; }
  const std::vector<FaceGroup>& groups() const { return groups_; }  ///< sorted by colour
  /// Per colour that occurs: end of its groups.
  const std::vector<std::size_t>& colour_ends() const { return colour_ends_; }
  /// Loops over fewer constraints than this are not worth several threads.
  static constexpr std::ptrdiff_t serial_below = 200;

 private:
  using Constraint = FaceConstraint<Dim>;

  void list_constraints(ContactNodes<Dim>& contacts);
  void find_terms(Constraint& c, std::span<const ContactMember> members) const;
  ComponentSigns fold(std::size_t field, Index<Dim>& node) const;
  void add_face_terms(Constraint& c, const ContactMember& member, double sign) const;
  struct Point;
  Point add_point(Constraint& c, std::size_t field, const Vec3& offset) const;
  void scale_weights(Point& point, double mean_mass) const;
  void number_velocities();
  void find_masses(Constraint& c) const;
  template <class F>
  void each_constraint(F&& f);

  System<Dim>& system_;
  const Exchanges<Dim>* exchanges_ = nullptr;  // of this step
  std::vector<Constraint> constraints_;
  std::vector<FaceGroup> groups_;
  std::vector<std::size_t> colour_ends_;
  std::vector<FaceVelocity> velocities_;
  std::vector<std::vector<std::int32_t>> number_of_;  // per field and node: position in velocities_, or -1
};

}  // namespace tribo
