// SPDX-License-Identifier: MIT
#include "geometry/ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

// Distance in the first quadrant for a >= b > 0, by bisection of Eberly's g(s) = (r z0/(s+r))^2 + (z1/(s+1))^2 - 1.
double first_quadrant(double a, double b, double x, double y) {
  if (y <= 0.0) {
    const double denominator = a * a - b * b;
    if (a * x < denominator) {
      const double c = a * x / denominator;
      return std::hypot(a * c - x, b * std::sqrt(std::max(0.0, 1.0 - c * c)));
    }
    return std::abs(x - a);
  }
  const double z0 = x / a, z1 = y / b, r = (a / b) * (a / b);
  double low = z1 - 1.0, high = std::hypot(r * z0, z1) - 1.0;
  double s = 0.0;
  for (int k = 0; k < 200; ++k) {
    s = 0.5 * (low + high);
    if (s == low || s == high) break;
    const double u = r * z0 / (s + r), v = z1 / (s + 1.0);
    (u * u + v * v > 1.0 ? low : high) = s;
  }
  return std::hypot(r * x / (s + r) - x, y / (s + 1.0) - y);
}

}  // namespace

double Ellipse::distance(double x, double y) const {
  x = std::abs(x), y = std::abs(y);
  if (a == b) return std::abs(std::hypot(x, y) - a);
  if (std::min(a, b) <= 0.0)  // a segment
    return std::hypot(std::max(0.0, x - a), std::max(0.0, y - b));
  return a > b ? first_quadrant(a, b, x, y) : first_quadrant(b, a, y, x);
}

double Ellipse::perimeter() const {
  const double large = std::max(a, b), small = std::min(a, b);
  if (large == 0.0) return 0.0;
  return 4.0 * large * std::comp_ellint_2(std::sqrt(1.0 - (small / large) * (small / large)));
}

double Ellipse::sharpest() const {
  const double large = std::max(a, b), small = std::min(a, b);
  return large == 0.0 ? 0.0 : small * small / large;
}

double Ellipse::sector(double start, double span) const {
  // The eccentric anomaly lies in the same quadrant as the polar angle, so full turns are counted separately.
  const auto anomaly = [this](double angle) {
    const double turns = std::floor(angle / turn);
    const double rest = angle - turns * turn;
    double phi = std::atan2(a * std::sin(rest), b * std::cos(rest));
    if (phi < 0.0) phi += turn;
    return turns * turn + phi;
  };
  return 0.5 * a * b * (anomaly(start + span) - anomaly(start));
}

Angles::Angles(double start, double end) : start_(start), span_(std::fmod(end - start, turn)) {
  if (span_ < 0.0) span_ += turn;
  full_ = span_ < 1e-12 || span_ > turn - 1e-12;
  if (full_) span_ = turn;
}

bool Angles::contains(double x, double y) const {
  if (full_ || (x == 0.0 && y == 0.0)) return true;
  double from_start = std::fmod(std::atan2(y, x) - start_, turn);
  if (from_start < 0.0) from_start += turn;
  return from_start <= span_ + 1e-12 || from_start >= turn - 1e-12;
}

}  // namespace tribo
