// SPDX-License-Identifier: MIT
/// The points of a line that the grid resolves.
#pragma once

#include "base/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tribo {

/// Numbers of the points that represent a line of many points, in order, with the first and the last one. A point is
/// left out if it lies on the segment between its kept neighbours to within 1e-3 of `cell`, the edge of a cell
/// [length], and this segment is not longer than a quarter of a cell. Shorter segments would cost time, but the nodal
/// velocities do not vary within them. Parts of the line are divided at the point farthest from their chord, and
/// where they are straight into segments that are as equal as the points permit.
std::vector<std::uint32_t> resolved_points(std::span<const Vec3> line, double cell);

}  // namespace tribo
