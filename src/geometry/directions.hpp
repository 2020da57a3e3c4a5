// SPDX-License-Identifier: MIT
/// Whether a surface of straight parts stands for a curved one.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cmath>
#include <set>

namespace tribo {

/// Collects the directions of edges or facets, of any length.
class Directions {
 public:
  void add(const Vec3& direction) {
    const double length = direction.norm();
    if (length <= 0.0 || curved()) return;
    std::array<long, 3> rounded{};
    for (int k = 0; k < 3; ++k) rounded[static_cast<std::size_t>(k)] = std::lround(1e3 * direction[k] / length);
    distinct_.insert(rounded);
  }
  /// More than twelve different directions: a polygon that approximates a circle rather than a wedge or a block.
  bool curved() const { return distinct_.size() > 12; }

 private:
  std::set<std::array<long, 3>> distinct_;
};

}  // namespace tribo
