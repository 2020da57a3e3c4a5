// SPDX-License-Identifier: MIT
/// Drawings with names.
#pragma once

#include "base/types.hpp"
#include "geometry/region.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tribo {

/// A drawing of one colour: points, lines and polygons between points; points alone are drawn as dots.
struct Layer {
  std::string name, note = {};
  std::array<int, 3> colour{};
  double width = 2.0, opacity = 1.0;
  bool shown = true;
  std::vector<Vec3> points = {};
  std::vector<std::vector<std::uint32_t>> lines = {}, polygons = {};

  void line(const Vec3& a, const Vec3& b);
  /// A line with a head at `b`.
  void arrow(const Vec3& a, const Vec3& b);
  /// The edges of a box; of a rectangle if it has no height in z.
  void box(const Bounds& bounds);
};

/// The list as JSON, without layers that are empty.
std::string json_of(const std::vector<Layer>& layers);

}  // namespace tribo
