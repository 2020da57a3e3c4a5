// SPDX-License-Identifier: MIT
/// Cauchy stress as a function of position.
#pragma once

#include "base/expression.hpp"
#include "base/types.hpp"
#include "geometry/scattered.hpp"

#include <array>
#include <memory>
#include <optional>

namespace tribo {

/// A stress field: functions of position for some components, and values at points.
struct StressField {
  std::array<std::optional<Expression>, 6> functions;  ///< xx yy zz xy yz xz; absent: not given
  double factor = 1.0;                                 ///< of the functions to consistent units
  std::shared_ptr<const ScatteredField> points;        ///< added to all components, in consistent units; null: none

  /// Whether any component is given.
  bool given() const;
  /// Sets the components of `stress` that are given to the values of the functions at `x`, and adds those of the
  /// points.
  void set(const Vec3& x, Mat3& stress) const;
};

}  // namespace tribo
