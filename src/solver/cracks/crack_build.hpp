// SPDX-License-Identifier: MIT
/// Cracks and their joints before the first step.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Puts the model's cracks, with the points of their joints, into a system whose bodies are there. `width`: nodes of a
/// stencil along an axis. Throws InputError for a joint outside of all bodies.
template <int Dim>
void add_cracks(const Model& model, System<Dim>& system, int width);

/// Lets a crack go on straight beyond an end, by pieces of a cell's size.
void extend_straight(Crack<2>& crack, const CrackTip& end, double cell, int cells);
/// Lets a crack grow from a tip to a point.
void grow_to(Crack<2>& crack, CrackTip& tip, const Vec<2>& x);

}  // namespace tribo
