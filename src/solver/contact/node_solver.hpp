// SPDX-License-Identifier: MIT
/// Contact impulses between all pairs of fields at one node.
#pragma once

#include "solver/contact/contact_nodes.hpp"

#include <cstddef>
#include <span>

namespace tribo {

/// Velocity of a member after the impulses of all pairs of its node [velocity]. `member`: position in `members`, as are
/// ContactPair::a and b.
Vec3 velocity_after(std::span<const ContactMember> members, std::span<const ContactPair> pairs, std::size_t member);

/// Finds the impulses of the pairs of a node so that each pair obeys its law for the velocities that the impulses of
/// all other pairs leave.
///
/// Projected Gauss-Seidel iteration. A pass goes through all pairs forward and backward, which makes its linear part
/// symmetric, so that the changes from pass to pass decrease steadily; they are extrapolated by Aitken's method. A
/// single pair needs no iteration. The impulses on the two members of a pair are equal and opposite, so momentum is
/// conserved to round-off. With frictionless laws the result minimises the kinetic energy under the constraint that no
/// gap closes further.
///
/// `members`: their trial and start velocities, masses. `pairs`: in, ContactState without velocities; out, impulse and
/// response. `pass`: imperfect interfaces act in the corrector only, see also hold_of. `warm_start`: begin with the
/// present impulses, not with zero.
void solve_node(std::span<ContactMember> members, std::span<ContactPair> pairs, ContactPass pass, bool warm_start);

}  // namespace tribo
