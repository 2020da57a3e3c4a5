// SPDX-License-Identifier: MIT
/// Impulses that act on faces, not on single nodes.
///
/// Where each node of two fields takes one velocity, two layers of nodes on both sides of the face move as one, and no
/// strain can differ, or exist next to a rigid body, between them: the first cells carry a wrong stress (20 per cent
/// RMS of a block between platens). Here what must not penetrate, or slide, is the velocity of each body at the face:
/// the mean of the node and of its mirror image in the face. The impulse acts on both by the same shares, so that it
/// never adds energy, wherever the face lies between the nodes. The price: all nodes are solved together, and the
/// numerical damping of nodes that move as one is gone.
#pragma once

#include "grid/nodes.hpp"
#include "solver/contact/node_solver.hpp"
#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

template <int Dim>
class FaceSolver {
 public:
  explicit FaceSolver(System<Dim>& system) : system_(system) {}

  /// Forgets all pairs, and the fields' old nodes.
  void clear();
  /// Adds a pair of the node at `index`; with `mirrored`, its face (pair.face, along the normal from the node) is
  /// known.
  void add(ContactPair& pair, std::span<const ContactMember> members, const Index<Dim>& index, bool mirrored);

  /// Applies the laws to the present velocities; accelerations follow if it is the `update` of the momentum.
  void meet(double dt, bool update);
  /// Takes the impulses back.
  void part();
  /// Applies the laws to velocities that a filter's increments changed; an increment becomes what contact made of it.
  void refine(bool update);

 private:
  // The relative velocity of a pair is a sum of shares of nodal velocities, and of the rigid body's.
  struct Term {
    std::size_t point;
    double share;
  };
  struct Row {
    ContactPair* pair;
    std::size_t first, end;                           // terms
    Vec3 rigid = Vec3::Zero(), trial = Vec3::Zero();  // velocity of the rigid one, and relative one without contact
    double mass_alone = 0.0, mass_among = 0.0;        // that an impulse moves; the second shared with all other rows
    Vec3 more = Vec3::Zero();                         // impulse of this sweep
  };
  struct Point {
    std::size_t field;
    std::int64_t at;
    double inverse_mass;
    Vec3 change = Vec3::Zero();  // of its velocity by contact
  };

  std::size_t point(std::size_t field, std::int64_t at);
  void add_image(const ContactPair& pair, const ContactMember& member, const Index<Dim>& index);
  template <class Value>
  Vec3 sum(const Row& row, Value&& value) const;
  void ask(Row& row, double mass);
  void push(const Row& row, const Vec3& impulse);
  void solve(bool update);

  System<Dim>& system_;
  std::vector<Row> rows_;
  std::vector<Term> terms_;
  std::vector<Point> points_;
  std::vector<std::vector<int>> number_;  // per field and node: its point, or -1
};

}  // namespace tribo
