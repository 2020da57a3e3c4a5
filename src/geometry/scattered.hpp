// SPDX-License-Identifier: MIT
/// Interpolation of values at scattered points.
#pragma once

#include "base/types.hpp"

#include <array>
#include <memory>
#include <vector>

namespace tribo {

/// Six values at each of a set of points. At other positions: the linear function fitted to the nearest points by
/// weighted least squares, with weights proportional to the inverse fourth power of the distance. It interpolates the
/// given values and is exact for linear fields. In directions in which the points have no extent it is constant.
class ScatteredField {
 public:
  using Values = std::array<double, 6>;

  /// `points` and `values` have the same size, at least one; z is used only if `dimension` is 3 [length].
  ScatteredField(std::vector<Vec3> points, std::vector<Values> values, int dimension);
  ~ScatteredField();

  Values at(const Vec3& x) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace tribo
