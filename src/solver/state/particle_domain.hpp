// SPDX-License-Identifier: MIT
/// Domains of particles, which deform with the particles.
#pragma once

#include "solver/state/system.hpp"

#include <cmath>
#include <cstdint>

namespace tribo {

/// The domain of a particle: a parallelepiped (in two dimensions a parallelogram) that deforms with F.
template <int Dim>
struct ParticleDomain {
  Vec<Dim> x;     ///< centre                                                        [length]
  Mat<Dim> axes;  ///< the columns are the half axes: vectors from the centre to the middles of sides  [length]

  /// The largest value of (y - origin) . n over all points y of the domain [length]. `n`: unit vector.
  double reach(const Vec<Dim>& origin, const Vec<Dim>& n) const {
    double r = (x - origin).dot(n);
    for (int k = 0; k < Dim; ++k) r += std::abs(axes.col(k).dot(n));
    return r;
  }
};

/// Computes the current domains of the particles of a body. It holds pointers to the particle columns, so it is valid
/// until the next sort.
template <int Dim>
class DomainReader {
 public:
  explicit DomainReader(Body<Dim>& body);
  /// The domain of particle i.
  ParticleDomain<Dim> operator()(std::uint32_t i) const {
    ParticleDomain<Dim> p = box(i);
    if (axes_[0]) deform_axes(i, p.axes);
    return p;
  }
  /// The domain of a particle of the same size along the axes of the grid at the start, as if its cell were not cut.
  ParticleDomain<Dim> box(std::uint32_t i) const {
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
  void deform_axes(std::uint32_t i, Mat<Dim>& axes) const {
    Mat<Dim> initial, F = Mat<Dim>::Identity();
    for (std::size_t k = 0; k < Dim * Dim; ++k) {
      const auto row = static_cast<Eigen::Index>(k / Dim), column = static_cast<Eigen::Index>(k % Dim);
      initial(row, column) = axes_[k][i];
      if (F_[0]) F(row, column) = F_[k][i];
    }
    axes = F * initial;
  }

  std::array<const double*, Dim> x_{};           // coordinates
  std::array<const double*, Dim> half_{};        // initial half sizes; null if all particles have the same size
  std::array<const double*, Dim * Dim> axes_{};  // initial half axes row by row; null if they are along the grid axes
  // deformation gradient row by row; null if the body does not keep it
  std::array<const double*, Dim * Dim> F_{};
  Vec<Dim> uniform_;  // the initial half size of all particles if half_ is null
};

}  // namespace tribo
