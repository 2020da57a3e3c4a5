// SPDX-License-Identifier: MIT
/// Stress at rest under the weight of the ground.
#pragma once

#include "particles/seed.hpp"

namespace tribo {

/// Adds to every seed whose piece has a K0 the stress of ground at rest: vertical the weight of everything above its
/// centre, whatever its material, up to the real surface; K0 times that in the other directions. Vertical is gravity's
/// direction. What lies above is counted along the vertical line through the centre, through the domains of the other
/// seeds; rigid ones weigh nothing.
/// Throws InputError if gravity has no direction along an axis of the grid.
void add_geostatic_stress(const Model& model, std::vector<Seed>& seeds);

}  // namespace tribo
