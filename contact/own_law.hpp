// SPDX-License-Identifier: MIT
/// What contact laws outside of this folder are written with. It is compiled here, once: inline functions that other
/// objects bring along could replace those of the laws, with other rounding.
#pragma once

#include "contact/contact_law.hpp"
#include "contact/friction.hpp"

namespace tribo {

/// The normal contact of rigid faces, and the tangential motion.
NormalContact rigid_contact_of(const ContactState& state);
/// The response of rigid faces that slide once the tangential impulse reaches a limit [mass velocity].
ContactResponse sliding_beyond(const ContactState& state, double limit);
/// The response with an impulse [mass velocity] on a: open without one, otherwise stick if it takes away the sliding.
ContactResponse response_with(const ContactState& state, const Vec3& impulse);

}  // namespace tribo
