// SPDX-License-Identifier: MIT
/// The velocity fields at a contact node and the pairs that they form.
#pragma once

#include "contact/contact_law.hpp"

#include <cstddef>
#include <cstdint>

namespace tribo {

/// One velocity field at a contact node.
struct ContactMember {
  std::size_t field = 0;               ///< number of the velocity field
  std::int64_t node = 0;               ///< position of the node in the node layers of the field
  double mass = 0.0;                   ///< nodal mass                                         [mass]
  double inverse_mass = 0.0;           ///< its inverse; 0 if the velocity is prescribed       [1/mass]
  Vec3 trial_velocity = Vec3::Zero();  ///< at the end of the step without contact             [velocity]
  Vec3 start_velocity = Vec3::Zero();  ///< at the start of the step                           [velocity]
};

/// A pair of velocity fields at a contact node: the state that its law reads, and the impulse that they exchange.
struct ContactPair {
  std::size_t a = 0, b = 0;            ///< the two members; the normal points from a to b
  const ContactLaw* law = nullptr;     ///< contact law between them
  int crack = -1;                      ///< number of the crack whose faces they are; -1: two bodies
  ContactState state;                  ///< what the law reads
  Vec3 impulse = Vec3::Zero();         ///< on a, opposite on b                                     [mass velocity]
  ContactResponse response;            ///< last response of the law
  Vec3 update_impulse = Vec3::Zero();  ///< impulse of the last momentum update   [mass velocity]
  ContactStatus update_status = ContactStatus::open;  ///< status in the last momentum update
  double friction_work = 0.0;          ///< dissipated by sliding in the last momentum update       [energy]
  bool has_no_face = false;            ///< no common face was found at this node: no impulse acts
  bool replaced_by_joint = false;      ///< a joint acts here in place of the contact law
  double face_position = 0.0;          ///< of the common face, along the normal from the node      [length]
  Vec3 final_velocity = Vec3::Zero();  ///< relative velocity after contact; only set by FaceSolver  [velocity]
};

}  // namespace tribo
