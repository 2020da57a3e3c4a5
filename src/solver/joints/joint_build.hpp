// SPDX-License-Identifier: MIT
/// Construction of joints between bodies.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Adds a surface of joints for every pair of materials with a joint law. The joints lie on the common face of the two
/// bodies, where sides of their particle domains are opposite each other within a twentieth of a cell
/// (common_face_pieces). Each joint represents at most half a cell of the face along each edge; its area is exactly
/// that of the intersection of the sides [length^2; per radian if axisymmetric]. Throws InputError if a pair has no
/// common face, shares a velocity field, has no particles, or is rigid on both sides.
template <int Dim>
void add_interfaces(const Model& model, System<Dim>& system);

}  // namespace tribo
