// SPDX-License-Identifier: MIT
/// Construction of cracks and of the joints along them, and changes of their geometry.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Adds the cracks of the model, with the joints along them, to a system that already contains the bodies. `width`:
/// number of nodes of a stencil along an axis. Throws InputError if a crack with a joint law lies outside of all
/// bodies, or if an end that the model declares to be a tip lies in no body.
template <int Dim>
void add_cracks(const Model& model, System<Dim>& system, int width);

/// Extends a crack straight beyond one of its ends by `cells` pieces. `cell`: length of each piece [length].
void extend_straight(Crack<2>& crack, const CrackTip& end, double cell, int cells);
/// Extends a crack from a tip to the point x [length], which becomes the new tip.
void grow_to(Crack<2>& crack, CrackTip& tip, const Vec<2>& x);

}  // namespace tribo
