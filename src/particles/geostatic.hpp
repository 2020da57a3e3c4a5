// SPDX-License-Identifier: MIT
/// Geostatic initial stress.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"

namespace tribo {

/// The seeds with the geostatic stress added to every seed whose piece has a K0. The vertical stress is minus the
/// weight per area of all material above the centre of the seed, up to the free surface; the horizontal stresses are K0
/// times that. The vertical direction is that of gravity. The weight is summed along the vertical line through the
/// centre, over the domains of the other seeds; rigid materials have no weight. Throws InputError if gravity is not
/// along an axis of the grid.
Seeds with_geostatic_stress(const Model& model, Seeds seeds);

}  // namespace tribo
