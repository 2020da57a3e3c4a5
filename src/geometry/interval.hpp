// SPDX-License-Identifier: MIT
/// Closed intervals and boxes with a tolerance for round-off.
#pragma once

#include "geometry/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tribo {

inline constexpr double rounding = 1e-12;  ///< tolerance relative to the largest coordinate involved
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Throws std::runtime_error unless all numbers are finite.
template <class... Numbers>
void require_finite(const char* what, Numbers... numbers) {
  if (!(std::isfinite(numbers) && ...))
    throw std::runtime_error(std::string(what) + " has a coordinate that is not finite");
}

/// The interval [low, high]; the ends may be given in either order.
class Interval {
 public:
  Interval(double a, double b)
      : low_(std::min(a, b)), high_(std::max(a, b)), slack_(rounding * std::max(std::abs(a), std::abs(b))) {}
  bool contains(double x) const { return x >= low_ - slack_ && x <= high_ + slack_; }
  double low() const { return low_; }
  double high() const { return high_; }
  double length() const { return high_ - low_; }
  double middle() const { return 0.5 * (low_ + high_); }
  double half() const { return 0.5 * (high_ - low_); }
  double slack() const { return slack_; }

 private:
  double low_, high_, slack_;
};

/// Bounds of a two-dimensional shape.
inline Bounds flat_bounds(const Interval& x, const Interval& y) {
  return {Vec3(x.low(), y.low(), -infinity), Vec3(x.high(), y.high(), infinity)};
}

}  // namespace tribo
