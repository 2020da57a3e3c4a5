// SPDX-License-Identifier: MIT
/// The contact nodes of a step, with their members and pairs.
#pragma once

#include "grid/nodes.hpp"
#include "solver/state/contact_pair.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace tribo {

/// The ways in which contact acts on the nodal velocities in a step.
enum class ContactPass {
  predictor,  ///< on extrapolated velocities, before a strain update; the particles take over the changes
  held,       ///< the same, but the changes only strain the particles: they are the adjoint of the last corrector
  corrector   ///< after the momentum update; its impulse is the contact impulse of the step
};

/// Whether the last momentum update gave the faces of a pair a shear impulse. Faces without friction have none.
inline bool sheared(const ContactPair& pair, const Vec3& normal) {
  constexpr double round_off = 1e-12;
  const Vec3& impulse = pair.update_impulse;
  return (impulse - impulse.dot(normal) * normal).norm() > round_off * impulse.norm();
}

/// Whether friction held the faces of a pair in the last momentum update. Without friction a pair without tangential
/// motion has the status stick, too, but no tangential impulse.
inline bool stuck(const ContactPair& pair, const Vec3& normal) {
  return pair.update_status == ContactStatus::stick && sheared(pair, normal);
}

/// What the faces of a pair keep of the relative velocity of the last momentum update when contact acts on extrapolated
/// velocities: nothing, its component along the face or along the normal, or all of it. The rest follows from the
/// contact law, except that faces that slide (`sliding`) keep the normal component and have no shear impulse.
enum class Hold { nothing, along_face, normal, sliding, all };

/// What the faces of a pair keep in a pass.
///
/// Before the momentum update, faces that friction held in the last update do not slide. In the pass `held`, all faces
/// on which an impulse acted keep the normal velocity of that update, and those that stuck all of it. The changes of
/// velocity in `held` are thereby the adjoint of what the impulses of the corrector do to the particles: impulses and
/// strains do the same work with opposite signs, and contact creates no energy. By the law alone, faces under pressure
/// would be held while the extrapolated velocities approach, in loading, but not while they separate, in unloading, and
/// each such cycle would add energy.
///
/// Faces that slide have no shear impulse in this pass. By a law with cohesion, whose limit does not depend on
/// pressure, the extrapolated velocities would stick where the faces slide, and the strains would not follow the
/// sliding. If they kept their slip velocity, a disc would vibrate while it slides, and gain 2 % too little spin in an
/// oblique impact (FLIP; 0.6 % otherwise).
///
/// A film of liquid holds faces in the normal direction only; its drag follows from the extrapolated velocities. Where
/// a law makes two fields one (IgnoreContact), they stick in every pass, to the last digit like one field.
inline Hold hold_of(const ContactPair& pair, ContactPass pass) {
  const bool holds = pair.law->uses_face() && !pair.law->interface() && !pair.update_impulse.isZero(0);
  if (pass == ContactPass::corrector || !holds) return Hold::nothing;
  const Vec3& normal = pair.state.normal;
  const bool shear = pair.law->liquid() == 0 && sheared(pair, normal), stick = shear && stuck(pair, normal);
  if (pass == ContactPass::predictor) return stick ? Hold::along_face : Hold::nothing;
  return stick ? Hold::all : shear ? Hold::sliding : Hold::normal;
}

/// The response of a pair in a state: that of its law, except for what its faces keep, see hold_of. The frictional
/// limit of the law does not apply to the impulse that holds faces, as it removes motions of the particles that the
/// nodes do not see and has nothing to do with the pressure between the bodies.
inline ContactResponse response_of(const ContactPair& pair, const ContactState& m, Hold hold) {
  if (hold == Hold::nothing) return pair.law->response(m);
  // A node that particles hardly reached in the last update may have had any velocity there. Once more of a body
  // reaches it, this velocity has the weight of the mass it belonged to.
  const double mass = std::min(m.mass, 2 * pair.update_mass);
  const Vec3 kept = mass * (m.velocity - pair.end_velocity);
  if (hold == Hold::all) return {kept, ContactStatus::stick, m.bond};
  if (hold == Hold::sliding) return {kept.dot(m.normal) * m.normal, ContactStatus::slip, m.bond};
  ContactResponse out = pair.law->response(m);
  const Vec3 change = kept - out.impulse;
  const Vec3 normal = change.dot(m.normal) * m.normal;
  out.impulse += hold == Hold::normal ? normal : Vec3(change - normal);
  return out;
}

/// A grid node that carries two or more velocity fields, at least one of them deformable.
template <int Dim>
struct ContactNode {
  Index<Dim> index{};                            ///< index in the lattice
  std::int64_t number = 0;                       ///< among the nodes of all blocks of the lattice
  bool own = true;                               ///< whether it counts in the sums of this process
  std::size_t first_member = 0, end_member = 0;  ///< range of ContactNodes::members
  std::size_t first_pair = 0, end_pair = 0;      ///< range of ContactNodes::pairs
  double ownership = 1.0;                        ///< weight of the node in sums over nodes, see Exchange::ownership
  int mirrored_axes = 0;                         ///< bit d: a symmetry plane normal to axis d passes through it
  bool solved_on_faces = false;                  ///< its impulses are found by FaceSolver, not by NodeImpulses
  bool needs_faces = true;                       ///< its faces must be found from the particles in this step
  bool has_approached = false;                   ///< some of its faces were apart and are no longer, see FaceCache
  bool idle = false;                             ///< no impulse can act in this step, and none acted in the last one
  bool between_bodies = false;                   ///< some pair is formed by two bodies, not by the faces of a crack
};

/// The contact nodes of a few neighbouring blocks. Behind the members and pairs of a part there is room for more, so
/// that those of the other parts keep their places when their number changes.
struct ContactPart {
  std::size_t first_node = 0, end_node = 0;      ///< range of ContactNodes::nodes
  std::size_t first_member = 0, end_member = 0;  ///< range of ContactNodes::members
  std::size_t member_room = 0;                   ///< the largest number of members that fit
  std::size_t first_pair = 0, end_pair = 0;      ///< range of ContactNodes::pairs
  std::size_t pair_room = 0;                     ///< the largest number of pairs that fit
  bool changed = true;                           ///< its nodes or members are others than in the last step
};

/// All contact nodes of a step. Members and pairs of a node are contiguous. Some elements of `members` and `pairs`
/// belong to no node, see ContactPart.
template <int Dim>
struct ContactNodes {
  std::vector<ContactNode<Dim>> nodes;
  std::vector<ContactMember> members;
  std::vector<ContactPair> pairs;
  std::vector<ContactPart> parts;  ///< in the order of their nodes
  bool moved = true;               ///< members and pairs of all parts have other places than in the last step

  std::span<ContactPair> pairs_of(const ContactNode<Dim>& node) {
    return {pairs.data() + node.first_pair, node.end_pair - node.first_pair};
  }
  std::span<const ContactPair> pairs_of(const ContactNode<Dim>& node) const {
    return {pairs.data() + node.first_pair, node.end_pair - node.first_pair};
  }
  /// The pairs of a node, none of an idle one.
  std::span<ContactPair> active_pairs_of(const ContactNode<Dim>& node) {
    return node.idle ? std::span<ContactPair>() : pairs_of(node);
  }
  void clear() { nodes.clear(), members.clear(), pairs.clear(), parts.clear(), moved = true; }
};

}  // namespace tribo
