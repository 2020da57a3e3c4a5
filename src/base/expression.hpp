/// Functions of time and position written by the user: `sin(2*pi*t)*x^2`.
#pragma once

#include "base/error.hpp"

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
};

/// A compiled expression; safe to evaluate from several threads, and cheap for constants.
/// Operators + - * / ^ and parentheses (a leading sign is applied after ^; ^ runs left to right), the variables above,
/// pi, and the dialect's functions: sin cos tan asin acos atan sinh cosh tanh log=ln log10 abs int sqrt exp erf erfc
/// sign (1|0) sgn ramp cosramp box sinbox tri mod; also comparisons and `a ? b : c`. No implicit multiplication.
class Expression {
 public:
  Expression() = default;  ///< the constant 0
  explicit Expression(double constant) : constant_(constant) {}
  /// Throws InputError at `origin` (column of the error inside the text added) with what is valid.
  Expression(const std::string& text, const Origin& origin);

  double operator()(const Variables& at) const;
  bool is_constant() const { return !compiled_; }
  const std::string& text() const { return text_; }

 private:
  struct Compiled;
  double constant_ = 0.0;
  std::string text_ = "0";
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace tribo
