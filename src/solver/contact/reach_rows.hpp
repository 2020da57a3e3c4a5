// SPDX-License-Identifier: MIT
/// A particle domain in the form in which its reach is computed fastest.
#pragma once

#include "base/simd.hpp"
#include "solver/state/particle_domain.hpp"

#include <array>
#include <cmath>

namespace tribo {

/// A particle domain, row by row: component d of its centre and of its half axes [length].
template <int Dim>
class ReachRows {
 public:
  ReachRows() = default;
  explicit ReachRows(const ParticleDomain<Dim>& p) {
    for (int d = 0; d < Dim; ++d) {
      double* row = rows_.data() + 4 * d;
      row[0] = p.x[d];
      for (int k = 0; k < Dim; ++k) row[k + 1] = p.axes(d, k);
    }
  }

  /// ParticleDomain::reach from the origin of the coordinates along n [length].
  double reach(const Vec<Dim>& n) const {
    Vec4 along = n[0] * load4(rows_.data());
    for (int d = 1; d < Dim; ++d) along += n[d] * load4(rows_.data() + 4 * d);
    const double of_axes = std::abs(along[1]) + std::abs(along[2]);
    return along[0] + (Dim == 2 ? of_axes : of_axes + std::abs(along[3]));
  }
  /// Its centre [length].
  Vec<Dim> centre() const {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = rows_[static_cast<std::size_t>(4 * d)];
    return x;
  }

 private:
  std::array<double, static_cast<std::size_t>(4 * Dim)> rows_{};
};

}  // namespace tribo
