// SPDX-License-Identifier: MIT
/// Vectors in the tangent plane of a contact.
#pragma once

#include "base/archive.hpp"

#include <cmath>

namespace tribo {

/// Components along the tangents s and t of a contact. Moments and rotations have components about them.
struct Tangent {
  double s = 0.0, t = 0.0;

  Tangent& operator+=(const Tangent& o) { return s += o.s, t += o.t, *this; }
  Tangent& operator-=(const Tangent& o) { return s -= o.s, t -= o.t, *this; }
  Tangent& operator*=(double f) { return s *= f, t *= f, *this; }
  friend Tangent operator+(Tangent a, const Tangent& b) { return a += b; }
  friend Tangent operator-(Tangent a, const Tangent& b) { return a -= b; }
  friend Tangent operator*(double f, Tangent a) { return a *= f; }
  double dot(const Tangent& o) const { return s * o.s + t * o.t; }
  double norm() const { return std::sqrt(dot(*this)); }
};

inline void archive(Archive& a, Tangent& tangent) {
  auto& [s, t] = tangent;
  a("s", s), a("t", t);
}

}  // namespace tribo
