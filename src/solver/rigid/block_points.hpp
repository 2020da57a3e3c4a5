// SPDX-License-Identifier: MIT
/// Particles that represent a rigid block in the grid.
#pragma once

#include "blocks/shape.hpp"
#include "particles/seed.hpp"

#include <vector>

namespace tribo {

/// Particles of a block with the given shape and centre [length]. A thin layer of parallelepipeds covers the faces, so
/// that contact is detected at the exact position of a face at any angle to the grid (for balls and discs within a
/// hundredth of a cell). Particles of half a cell fill the interior. The volumes sum to that of the block. `density`:
/// [mass/length^3]; `plane`: plane analysis with `thickness` [length]; `cell`: smallest edge of a cell [length].
std::vector<Seed> block_points(const BlockShape& shape, const Vec3& centre, int material, double density, bool plane,
                               double thickness, double cell);

}  // namespace tribo
