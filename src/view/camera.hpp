// SPDX-License-Identifier: MIT
/// Projection of points in space to the picture.
#pragma once

#include "base/types.hpp"

#include <string>
#include <vector>

namespace tribo {

/// A parallel projection: right, up and towards the eye are unit vectors.
struct Camera {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), eye = Vec3::UnitZ();
  /// Names of the axes along right and up; empty if they are none.
  std::string right_name = "x", up_name = "y";

  Vec3 project(const std::array<double, 3>& x) const {
    const Vec3 p(x[0], x[1], x[2]);
    return {right.dot(p), up.dot(p), eye.dot(p)};
  }
};

/// `xy`, `xz`, `yz`, or `iso` with y up, `iso-z` with z up. Throws UsageError for other names.
Camera camera(const std::string& view);

/// The distance between neighbouring particles: the 80th percentile, over a sample, of the distance to the nearest one.
double spacing_of(const std::vector<std::array<double, 3>>& positions);

}  // namespace tribo
