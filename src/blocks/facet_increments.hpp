// SPDX-License-Identifier: MIT
/// Increments of facets in space.
#pragma once

#include "blocks/assembly.hpp"

namespace tribo {

/// Relative motion of the bodies at the facets from `begin` to before `end` in a step of length dt [time], into one
/// element of `to` for each. Updates the axes and positions of the facets. Four facets are computed at a time, by the
/// formulas of `carried` and `count_increment`.
void facet_increments(Assembly& blocks, std::size_t begin, std::size_t end, double dt, JointIncrement* to);

}  // namespace tribo
