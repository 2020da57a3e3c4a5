// SPDX-License-Identifier: MIT
/// The velocity fields at a contact node and the pairs that they form.
#pragma once

#include "contact/contact_law.hpp"

#include <cstddef>
#include <cstdint>

namespace tribo {

struct VolumeNode;

/// One velocity field at a contact node.
struct ContactMember {
  std::size_t field = 0;      ///< number of the velocity field
  std::int64_t node = 0;      ///< position of the node in the nodal arrays of the field
  double mass = 0.0;          ///< nodal mass                                         [mass]
  double inverse_mass = 0.0;  ///< its inverse; 0 if the velocity is prescribed       [1/mass]
  /// Volume and volume gradient at the node; valid while its faces are found, see NodalVolumes.
  const VolumeNode* volumes = nullptr;
  Vec3 trial_velocity = Vec3::Zero();  ///< velocity at the end of the step without contact             [velocity]
  Vec3 start_velocity = Vec3::Zero();  ///< velocity at the start of the step                           [velocity]
  Vec3 velocity = Vec3::Zero();  ///< after the impulses, in solve_node(), against one of the members    [velocity]
};

/// A contact pair: two velocity fields at a contact node, the input of their contact law, and the impulse between
/// them.
struct ContactPair {
  std::size_t a = 0, b = 0;         ///< indices of the two members; the normal points from a to b
  const ContactLaw* law = nullptr;  ///< contact law between them
  int crack = -1;                   ///< number of the crack if the fields are its two sides; -1: two bodies
  ContactState state;               ///< input of the contact law
  Vec3 impulse = Vec3::Zero();      ///< contact impulse on a; the opposite acts on b [mass velocity]
  Vec3 applied = Vec3::Zero();      ///< the part of it in the nodal accelerations; a filter changes the rest
  Vec3 at_start = Vec3::Zero();     ///< contact impulse on a by which velocities at the start changed [mass velocity]
  ContactResponse response;         ///< last contact response of the law
  Vec3 update_impulse = Vec3::Zero();  ///< impulse on a of the last momentum update      [mass velocity]
  double update_mass = 0.0;            ///< ContactState::mass of that update                          [mass]
  Vec3 total_impulse = Vec3::Zero();   ///< the same with what the particles keep of at_start   [mass velocity]
  Vec3 strain_velocity =
      Vec3::Zero();                  ///< relative velocity that strains the particles at the start (USAVG) [velocity]
  Vec3 end_velocity = Vec3::Zero();  ///< relative velocity after the last momentum update and its filter [velocity]
  /// Relative velocity of the deformable members after the last momentum update and its filter, zero for rigid members
  /// [velocity].
  Vec3 update_velocity = Vec3::Zero();
  ContactStatus update_status = ContactStatus::open;  ///< contact status in the last momentum update
  double friction_work = 0.0;      ///< energy dissipated by sliding in the last momentum update       [energy]
  bool needs_face = true;          ///< its face must be found from the particles in this step
  bool has_no_face = false;        ///< no common face was found at this node, so no impulse acts
  bool replaced_by_joint = false;  ///< a joint acts here in place of the contact law
  bool apart = false;              ///< its faces are so far apart that they cannot meet within the step
  double face_position = 0.0;      ///< signed distance of the common face from the node along the normal      [length]
  /// Offset along the face, from the line through the node along the normal, of the points that determine the gap. The
  /// velocity at a curved face is that at this place, and the impulse acts there [length].
  Vec3 foremost_offset = Vec3::Zero();
  Vec3 final_velocity = Vec3::Zero();  ///< relative velocity after contact; set only by FaceSolver  [velocity]
  /// Contribution of a field with prescribed velocity to the relative velocity at the face; set only by FaceSolver
  /// [velocity].
  Vec3 rigid_velocity = Vec3::Zero();

  /// Whether an impulse of the contact law may act in this step.
  bool may_touch() const { return !has_no_face && !replaced_by_joint && !apart; }
  /// Whether an impulse acts, or has changed velocities in this step.
  bool has_impulse() const { return !impulse.isZero(0) || !applied.isZero(0) || !at_start.isZero(0); }
};

}  // namespace tribo
