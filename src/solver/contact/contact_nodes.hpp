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
  predictor,  ///< on extrapolated velocities, by the laws, before a strain update
  held,       ///< the same, but faces on which an impulse acted keep the relative velocity of the last momentum update
  corrector   ///< after the momentum update; its impulse is the contact impulse of the step
};

/// The response of the law of a pair in a state.
///
/// In the predictor, faces that friction held in the last momentum update (ContactPair::stuck) do not slide. The
/// extrapolated velocities of two bodies that stick differ, since the particles keep motions that the nodes do not see.
/// The impulse that removes this difference has nothing to do with the pressure between the bodies, so the frictional
/// limit of the law does not apply to it. With the limit most nodes would slide in the predictor, with two
/// consequences. The strains of USF, USAVG and the "+" variants would belong to faces that slide, the forces to faces
/// that stick, which adds energy in every step. And FLIP would give the difference to the corrector as a shear impulse.
///
/// `held` does the same for the normal direction, too. The work of an impulse is its product with the velocity that
/// strains the bodies. By the law, faces under pressure would be held while the extrapolation makes them approach, in
/// loading, but not while it makes them separate, in unloading: contact would create energy. A film of liquid holds
/// faces in the normal direction only; its drag follows from the extrapolated velocities. Where a law makes two fields
/// one (IgnoreContact), they stick in every pass, to the last digit like one field.
inline ContactResponse response_of(const ContactPair& pair, const ContactState& m, ContactPass pass) {
  ContactResponse out = pair.law->response(m);
  if (pass == ContactPass::corrector) return out;
  const auto holds = [&] { return pair.law->uses_face() && !pair.law->interface(); };
  if (pass == ContactPass::held && !pair.update_impulse.isZero(0) && holds()) {
    // A node that particles hardly reached in the last update may have had any velocity there. Once more of a body
    // reaches it, this velocity has the weight of the mass it belonged to.
    const double mass = std::min(m.mass, 2 * pair.update_mass);
    const Vec3 held = mass * (m.velocity - pair.end_velocity);
    if (pair.law->liquid() != 0)
      out.impulse += (held - out.impulse).dot(m.normal) * m.normal;
    else
      out.impulse = held;
  } else if (pair.stuck) {
    const Vec3 slide = m.velocity - m.velocity.dot(m.normal) * m.normal;
    out.impulse = out.impulse.dot(m.normal) * m.normal + m.mass * slide;
  }
  return out;
}

/// A grid node that carries two or more velocity fields, at least one of them deformable.
template <int Dim>
struct ContactNode {
  Index<Dim> index{};                            ///< index in the lattice
  std::int64_t number = 0;                       ///< among the nodes of all shared blocks, see ContactSearch
  std::size_t first_member = 0, end_member = 0;  ///< range of ContactNodes::members
  std::size_t first_pair = 0, end_pair = 0;      ///< range of ContactNodes::pairs
  double ownership = 1.0;                        ///< weight of the node in sums over nodes, see Exchange::ownership
  int mirrored_axes = 0;                         ///< bit d: a symmetry plane normal to axis d passes through it
  bool solved_on_faces = false;                  ///< its impulses are found by FaceSolver, not by NodeImpulses
  bool needs_faces = true;                       ///< its faces must be found from the particles in this step
  bool between_bodies = false;                   ///< some pair is formed by two bodies, not by the faces of a crack
};

/// All contact nodes of a step. Members and pairs of a node are contiguous.
template <int Dim>
struct ContactNodes {
  std::vector<ContactNode<Dim>> nodes;
  std::vector<ContactMember> members;
  std::vector<ContactPair> pairs;

  std::span<ContactPair> pairs_of(const ContactNode<Dim>& node) {
    return {pairs.data() + node.first_pair, node.end_pair - node.first_pair};
  }
  std::span<const ContactPair> pairs_of(const ContactNode<Dim>& node) const {
    return {pairs.data() + node.first_pair, node.end_pair - node.first_pair};
  }
  void clear() { nodes.clear(), members.clear(), pairs.clear(); }
};

}  // namespace tribo
