// SPDX-License-Identifier: MIT
/// Joints between bodies, before the first step.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Adds a surface of joints for every pair of materials that has a joint law, where the domains of their particles
/// touch: sides of domains that lie opposite each other within a twentieth of a cell. Each point stands for half a cell
/// of the face or less; areas are those of what the sides have in common, exactly [length^2; per radian if
/// axisymmetric]. Throws InputError if a pair touches nowhere, shares a velocity field, has no particles, or is rigid
/// on both sides.
template <int Dim>
void add_interfaces(const Model& model, System<Dim>& system);

}  // namespace tribo
