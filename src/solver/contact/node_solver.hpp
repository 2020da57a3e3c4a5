// SPDX-License-Identifier: MIT
/// The impulses of all pairs of fields that meet at one node.
#pragma once

#include "solver/state/contact_pair.hpp"

#include <cstddef>
#include <span>

namespace tribo {

/// Velocity of a member after the impulses of the pairs.
Vec3 velocity_after(std::span<const ContactMember> members, std::span<const ContactPair> pairs, std::size_t member);

/// Finds impulses so that each pair obeys its law given those of all others: projected Gauss-Seidel in an order that is
/// its own mirror image. One pair needs one sweep. Equal and opposite by construction, so momentum is kept to
/// round-off; for frictionless laws the kinetic energy is the least that no overlap allows. `interfaces`: imperfect
/// interfaces act, too; `warm`: begin with the present impulses.
void solve_node(std::span<const ContactMember> members, std::span<ContactPair> pairs, bool interfaces, bool warm);

}  // namespace tribo
