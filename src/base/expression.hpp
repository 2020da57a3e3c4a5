// SPDX-License-Identifier: MIT
/// Functions of time and position given in the input, e.g. `sin(2*pi*t)*x^2`.
#pragma once

#include "base/error.hpp"
#include "base/types.hpp"

#include <memory>
#include <string>

namespace tribo {

/// Values an expression may depend on.
struct Variables {
  double t = 0;  ///< time, in the unit of functions in the input (ms in legacy files)
  double x = 0, y = 0, z = 0;
  double dt = 0;
  double q = 0;                       ///< rotation angle of a particle [rad]
  double R = 0, Z = 0, D = 0, T = 0;  ///< further variables of NairnMPM: radius, axial position, distance, angle
  double x0 = 0, y0 = 0, z0 = 0;      ///< initial position of a particle

  /// Variables at a position: R = x, Z = y, and D, T = polar coordinates of (x, y) [length, rad].
  static Variables at(const Vec3& position, double time = 0.0);
};

/// A compiled expression. It can be evaluated from several threads, and constants are cheap.
///
/// Operators by decreasing precedence: parentheses and functions; ^ from left to right (2^3^2 = 64); a leading sign
/// (-x^2 = -(x^2), 2^-3 = 1/8); * and /; + and -; < <= > >= == != (1 or 0); &&; ||; a ? b : c.
/// Names are the variables above (case-sensitive), `pi`, and the functions of NairnMPM (in any case):
///   sin cos tan asin acos atan sinh cosh tanh exp sqrt abs erf erfc     as in mathematics, angles in radians
///   log(x) = ln(x), log10(x)     natural and decimal logarithm
///   int(x)                       integer part, rounded towards zero
///   mod(x,y)                     remainder of x/y with the sign of x
///   sign(x), sgn(x)              1 for x > 0, else 0; -1, 0 or 1
///   ramp(A,x), cosramp(A,x)      0 for x < 0, A for x > 1, between A x and A (1 - cos(pi x))/2
///   box(A,x), sinbox(A,x)        0 outside 0 <= x <= 1, inside A and A sin(pi x)
///   min, max                     of two or more arguments
/// Arguments are separated by , or ;. There is no implicit multiplication.
class Expression {
 public:
  static constexpr std::size_t longest = 10000;  ///< largest number of characters
  static constexpr std::size_t deepest = 200;    ///< largest depth of nested parentheses

  Expression() = default;  ///< the constant 0
  explicit Expression(double constant);
  /// Throws InputError at the place of the error in the text, with what is valid. `keyword`: whose value it is, for
  /// messages.
  Expression(const std::string& text, const Origin& origin, std::string keyword = {});

  /// Throws SimulationError with the text and its place if the value is not finite.
  double operator()(const Variables& at) const;
  bool is_constant() const { return !compiled_; }
  bool uses_start() const { return uses_start_; }  ///< depends on x0, y0 or z0, which only particles have
  const std::string& text() const { return text_; }

 private:
  struct Compiled;
  [[noreturn]] void refuse(const Variables& at) const;
  double constant_ = 0.0;
  bool uses_start_ = false;
  std::string text_ = "0";
  Origin origin_;
  std::string keyword_;
  std::shared_ptr<Compiled> compiled_;
};

}  // namespace tribo
