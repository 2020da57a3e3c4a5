// SPDX-License-Identifier: MIT
/// Traction of one mode (opening or sliding) of a cohesive zone as a function of its displacement, while that grows.
#pragma once

#include <algorithm>
#include <memory>

namespace tribo {

/// A curve T(d), 0 <= d <= critical(), with T(0) = 0 and a secant T/d that never grows. The area under it is the
/// energy per area that the zone takes until it has failed.
class TractionCurve {
 public:
  virtual ~TractionCurve() = default;

  /// T(d) [stress], 0 beyond critical().
  virtual double traction(double d) const = 0;
  /// The area under the curve up to d [energy/area].
  virtual double area(double d) const = 0;
  /// The displacement at which T/d is the share 1 - damage of the initial slope [length].
  virtual double at_damage(double damage) const;
  /// Initial slope [stress/length].
  virtual double slope() const = 0;
  /// The largest displacement without damage [length].
  virtual double elastic_limit() const = 0;
  /// The displacement at which the traction has vanished [length]; infinite: it never does.
  virtual double critical() const = 0;
  /// The largest traction [stress].
  virtual double peak() const = 0;

  /// The area under the whole curve [energy/area].
  double toughness() const { return area(critical()); }
  /// T/d [stress/length]; the initial slope at d = 0.
  double secant(double d) const { return d > elastic_limit() ? traction(d) / d : slope(); }
  /// 1 - secant/slope, 1 from critical() on.
  double damage(double d) const { return slope() > 0 ? std::max(0.0, 1 - secant(d) / slope()) : 0.0; }
  /// Energy per area that has been dissipated once d has been reached: the area without the triangle below the secant.
  double dissipated(double d) const { return std::max(0.0, area(d) - 0.5 * secant(d) * d * d); }
};

using SharedCurve = std::shared_ptr<const TractionCurve>;

/// T = k d without end.
SharedCurve linear_curve(double slope);
/// Straight lines through (0, 0), (d1, T1), (d2, T2), (critical, 0) with 0 < d1 <= d2 <= critical.
SharedCurve piecewise_curve(double d1, double T1, double d2, double T2, double critical);
/// T = 27/4 peak x (1 - x)^2 with x = d/critical.
SharedCurve cubic_curve(double peak, double critical);
/// A straight line to (d1, peak), then peak (e^(-alpha x) - e^-alpha)/(1 - e^-alpha), x = (d - d1)/(critical - d1).
SharedCurve exponential_curve(double d1, double peak, double critical, double alpha);

}  // namespace tribo
