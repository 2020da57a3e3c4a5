// SPDX-License-Identifier: MIT
/// Voronoi cells in space, by Voro++.
#pragma once

#include "blocks/shape.hpp"

namespace tribo {

/// As `voronoi` in three dimensions; the nuclei have been checked.
Tessellation voronoi_3d(std::span<const Vec3> nuclei, const Vec3& low, const Vec3& high,
                        const std::array<bool, 3>& periodic);

}  // namespace tribo
