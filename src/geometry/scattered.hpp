// SPDX-License-Identifier: MIT
/// Values known at scattered points.
#pragma once

#include "base/types.hpp"

#include <array>
#include <memory>
#include <vector>

namespace tribo {

/// Six values at each of some points. In between, the linear function that fits the nearest points best (least squares
/// with weights that fall with the fourth power of the distance): it meets the values at the points and is exact where
/// they are linear. In directions in which the points do not spread it is constant.
class ScatteredField {
 public:
  using Values = std::array<double, 6>;

  /// As many points as values, at least one; z counts only if `dimension` is 3 [length].
  ScatteredField(std::vector<Vec3> points, std::vector<Values> values, int dimension);
  ~ScatteredField();

  Values at(const Vec3& x) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace tribo
