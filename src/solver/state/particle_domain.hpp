// SPDX-License-Identifier: MIT
/// Domains of particles, deformed with them.
#pragma once

#include "solver/state/system.hpp"

#include <cmath>
#include <cstdint>

namespace tribo {

/// A particle as a parallelepiped: centre and half axes, deformed with F.
template <int Dim>
struct ParticleDomain {
  Vec<Dim> x;
  Mat<Dim> axes;  ///< columns: half axes of the domain

  /// How far the domain reaches from `origin` along n.
  double reach(const Vec<Dim>& origin, const Vec<Dim>& n) const {
    double r = (x - origin).dot(n);
    for (int k = 0; k < Dim; ++k) r += std::abs(axes.col(k).dot(n));
    return r;
  }
};

/// Reads the domains of a body's particles as they are now; to be made anew for every step.
template <int Dim>
class DomainReader {
 public:
  explicit DomainReader(Body<Dim>& body);
  ParticleDomain<Dim> operator()(std::uint32_t i) const {
    ParticleDomain<Dim> p;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      p.x[axis] = x_[d][i];
      const double half = half_[d] ? half_[d][i] : uniform_[axis];
      for (std::size_t row = 0; row < Dim; ++row)
        p.axes(static_cast<Eigen::Index>(row), axis) = (F_[0] ? F_[row * Dim + d][i] : row == d ? 1.0 : 0.0) * half;
    }
    return p;
  }

 private:
  std::array<const double*, Dim> x_{}, half_{};  // half_: null if all are alike
  std::array<const double*, Dim * Dim> F_{};     // row by row; null if not kept
  Vec<Dim> uniform_;
};

}  // namespace tribo
