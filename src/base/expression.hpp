// SPDX-License-Identifier: MIT
/// Functions of time and position written by the user: `sin(2*pi*t)*x^2`.
#pragma once

#include "base/error.hpp"
#include "base/types.hpp"

#include <memory>
#include <string>

namespace tribo {

/// Values an expression may depend on.
struct Variables {
  double t = 0;  ///< time, in the unit the file uses for functions (ms in legacy files)
  double x = 0, y = 0, z = 0;
  double dt = 0;
  double q = 0;                       ///< rotation angle of a particle [rad]
  double R = 0, Z = 0, D = 0, T = 0;  ///< dialect's further names: radius, axial position, distance, angle
  double x0 = 0, y0 = 0, z0 = 0;      ///< where a particle was at the start of the run

  /// At a position: R = x, Z = y, and D, T = polar coordinates of (x, y) [length, rad].
  static Variables at(const Vec3& position, double time = 0.0);
};

/// A compiled expression; safe to evaluate from several threads, and cheap for constants.
///
/// From strongest to weakest: parentheses and functions; ^ from left to right (2^3^2 = 64); a leading sign
/// (-x^2 = -(x^2), 2^-3 = 1/8); * and /; + and -; < <= > >= == != (1 or 0); &&; ||; a ? b : c.
/// The variables above (case matters), `pi`, and the functions below (any case), which are the dialect's:
///   sin cos tan asin acos atan sinh cosh tanh exp sqrt abs erf erfc     as in mathematics, angles in radians
///   log(x) = ln(x), log10(x)     natural and decimal logarithm
///   int(x)                       without its fraction, towards zero
///   mod(x,y)                     remainder of x/y with the sign of x
///   sign(x), sgn(x)              1 for x > 0, else 0; -1, 0 or 1
///   ramp(A,x), cosramp(A,x)      0 for x < 0, A for x > 1, between A x and A (1 - cos(pi x))/2
///   box(A,x), sinbox(A,x)        0 outside 0 <= x <= 1, inside A and A sin(pi x)
///   min, max                     of two or more arguments
/// Arguments are separated by , or ;. There is no implicit multiplication.
class Expression {
 public:
  static constexpr std::size_t longest = 10000;  ///< characters of a text
  static constexpr std::size_t deepest = 200;    ///< parentheses inside each other

  Expression() = default;  ///< the constant 0
  explicit Expression(double constant);
  /// Throws InputError at `origin` (column of the error inside the text added) with what is valid.
  Expression(const std::string& text, const Origin& origin);

  double operator()(const Variables& at) const;
  bool is_constant() const { return !compiled_; }
  bool uses_start() const { return uses_start_; }  ///< depends on x0, y0 or z0, which only particles have
  const std::string& text() const { return text_; }

 private:
  struct Compiled;
  double constant_ = 0.0;
  bool uses_start_ = false;
  std::string text_ = "0";
  std::shared_ptr<Compiled> compiled_;
};

}  // namespace tribo
