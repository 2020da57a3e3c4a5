// SPDX-License-Identifier: MIT
/// A closed triangulated surface with shared corners, in which every edge belongs to exactly two facets.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace tribo {

struct Surface {
  std::vector<Vec3> corners;
  std::vector<std::array<std::int32_t, 3>> facets;
  bool oriented = false;  ///< the facets are consistently oriented
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  /// Merges corners closer than `tolerance`, removes facets without area, and checks that the surface is closed.
  /// Throws std::runtime_error naming the ends of an edge that does not belong to exactly two facets.
  Surface(const std::vector<std::array<Vec3, 3>>& triangles, double tolerance);

  /// Volume by the divergence theorem; only for an oriented surface.
  std::optional<double> volume() const;
};

}  // namespace tribo
