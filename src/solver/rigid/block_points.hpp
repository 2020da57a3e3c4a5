// SPDX-License-Identifier: MIT
/// Material points that stand for a rigid block in the grid.
#pragma once

#include "blocks/shape.hpp"
#include "particles/seed.hpp"

#include <vector>

namespace tribo {

/// Points of a block whose `shape` lies about `centre`: a thin skin of parallelepipeds that covers its faces, so that
/// contact finds them where they are at any angle to the grid (balls and discs within a hundredth of a cell), and
/// points of half a cell inside. Their volumes add up to that of the block. `cell`: smallest edge of a cell.
std::vector<Seed> block_points(const BlockShape& shape, const Vec3& centre, int material, double density, bool plane,
                               double thickness, double cell);

}  // namespace tribo
