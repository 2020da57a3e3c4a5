// SPDX-License-Identifier: MIT
/// A closed triangulated surface: corners that are one, edges that belong to exactly two facets.
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
  bool oriented = false;  ///< neighbouring facets agree on which side is outside
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  /// Joins corners nearer than `tolerance`, drops facets without area, and checks that the surface is closed.
  /// Throws std::runtime_error naming the ends of an edge that does not belong to exactly two facets.
  Surface(const std::vector<std::array<Vec3, 3>>& triangles, double tolerance);

  /// Divergence theorem; only of an oriented surface.
  std::optional<double> volume() const;
};

}  // namespace tribo
