/// The impulses of all pairs of fields that meet at one node.
#pragma once

#include "contact/contact_law.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace tribo {

/// One field at a node.
struct ContactMember {
  std::size_t field = 0;
  std::int64_t at = 0;                    ///< position of the node in the field's layers
  double mass = 0.0, inverse_mass = 0.0;  ///< inverse 0: rigid
  Vec3 trial = Vec3::Zero();              ///< velocity at the end of the step without contact
  Vec3 start = Vec3::Zero();              ///< and at its start
};

/// Two of them.
struct ContactPair {
  std::size_t a = 0, b = 0;  ///< members
  const ContactLaw* law = nullptr;
  int crack = -1;  ///< between the faces of this crack, or between bodies
  Meeting meeting;
  Vec3 impulse = Vec3::Zero();  ///< on a
  Answer answer;
  Vec3 booked = Vec3::Zero();  ///< impulse and state of the last update, for output
  Touch shown = Touch::open;
  double friction = 0.0;      ///< work of sliding in the last update                           [energy]
  bool apart = false;         ///< they have no faces here
  bool jointed = false;       ///< a joint acts between them here, not the law
  double face = 0.0;          ///< where it is, along the normal from the node                 [length]
  Vec3 after = Vec3::Zero();  ///< relative velocity that contact leaves; only of FaceImpulses
};

/// Velocity of a member after the impulses of the pairs.
Vec3 velocity_after(std::span<const ContactMember> members, std::span<const ContactPair> pairs, std::size_t member);

/// Finds impulses so that each pair obeys its law given those of all others: projected Gauss-Seidel in an order that is
/// its own mirror image. One pair needs one sweep. Equal and opposite by construction, so momentum is kept to
/// round-off; for frictionless laws the kinetic energy is the least that no overlap allows. `interfaces`: imperfect
/// interfaces act, too; `warm`: begin with the present impulses.
void solve_pairs(std::span<const ContactMember> members, std::span<ContactPair> pairs, bool interfaces, bool warm);

}  // namespace tribo
