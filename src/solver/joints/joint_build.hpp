// SPDX-License-Identifier: MIT
/// Construction of joints between bodies.
#pragma once

#include "solver/joints/common_faces.hpp"

namespace tribo {

/// Adds one joint to a surface. It consists of the pieces first ... end - 1 of a common face; `thickness`: that of a
/// plane model [length]. JointSurface::mass is left to the caller.
template <int Dim>
void add_joint(const std::vector<CommonFacePiece<Dim>>& pieces, std::size_t first, std::size_t end, double thickness,
               JointSurface<Dim>& surface);

/// Adds a surface of joints for every pair of materials with a joint law. The joints lie on the common face of the two
/// bodies, where sides of their particle domains are opposite each other within a twentieth of a cell
/// (common_face_pieces). Each joint represents at most half a cell of the face along each edge; its area is exactly
/// that of the intersection of the sides [length^2; per radian if axisymmetric]. Throws InputError if a pair has no
/// common face, shares a velocity field, has no particles, or is rigid on both sides. Adds the surfaces of imperfect
/// interfaces, too, without joints yet (add_imperfect_interfaces).
template <int Dim>
void add_interfaces(const Model& model, System<Dim>& system);

}  // namespace tribo
