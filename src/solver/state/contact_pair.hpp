// SPDX-License-Identifier: MIT
/// Velocity fields at a node and the pairs they make for contact.
#pragma once

#include "contact/contact_law.hpp"

#include <cstddef>
#include <cstdint>

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
  ContactState state;
  Vec3 impulse = Vec3::Zero();  ///< on a
  ContactResponse response;
  Vec3 booked = Vec3::Zero();  ///< impulse and state of the last update, for output
  ContactStatus shown = ContactStatus::open;
  double friction = 0.0;      ///< work of sliding in the last update                           [energy]
  bool apart = false;         ///< they have no faces here
  bool jointed = false;       ///< a joint acts between them here, not the law
  double face = 0.0;          ///< where it is, along the normal from the node                 [length]
  Vec3 after = Vec3::Zero();  ///< relative velocity that contact leaves; only of FaceImpulses
};

}  // namespace tribo
