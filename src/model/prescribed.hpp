// SPDX-License-Identifier: MIT
/// Values of boundary conditions and loads, and the styles in which they depend on time, place and motion.
#pragma once

#include "base/expression.hpp"
#include "base/units.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tribo {

struct Prescribed;

/// The state of a node or of a particle on which a condition acts.
struct ConditionPoint {
  double time = 0.0, dt = 0.0;
  Vec3 position = Vec3::Zero();
  double velocity = 0.0;      ///< component along the direction of the condition   [length/time]; particles only
  double displacement = 0.0;  ///< the same component, since the start of the run   [length]; particles only
  double impedance = 0.0;     ///< density times the speed of pressure waves        [stress time/length]; particles only
};

/// One way in which a prescribed value depends on time, place and motion. `styles` in prescribed.cpp lists them all.
struct Style {
  std::string_view words;  ///< words of command files, separated by blanks
  /// Meaning of the attribute `time` of the condition.
  enum class Time { start, angular_frequency } time = Time::start;
  Dimension per = Dimension::none;  ///< the value is given per unit of this: time or length
  bool function = false;            ///< the value is given by the attribute `function`
  bool motion = false;              ///< depends on the motion of particles: for tractions only
  bool elastic = false;             ///< the value is a stiffness, which limits the time step
  double (*at)(const Prescribed&, const ConditionPoint&) = nullptr;
};

/// The style that a word means; null if there is none.
const Style* style_of(std::string_view word);
/// The words of all styles, separated by blanks.
const std::string& all_style_words();

/// A prescribed value.
struct Prescribed {
  const Style* style = style_of("constant");
  double value = 0.0;
  double time = 0.0;  ///< start, or angular frequency
  Expression function;
  double function_time = 1.0;   ///< consistent time of one unit of the function's argument t
  double function_scale = 1.0;  ///< factor of the function's value to consistent units

  double at(const ConditionPoint& point) const { return style->at(*this, point); }
  double at(double t, const Vec3& x, double dt = 0.0) const { return at({.time = t, .dt = dt, .position = x}); }
  /// Stiffness of an elastic condition [stress/length]; 0 for all others.
  double stiffness() const { return style->elastic ? value : 0.0; }
};

}  // namespace tribo
