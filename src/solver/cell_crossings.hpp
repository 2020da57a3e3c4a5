// SPDX-License-Identifier: MIT
/// Counts how often particles move to another cell of the grid, if the output contains this quantity.
#pragma once

#include "base/parallel.hpp"
#include "solver/state/system.hpp"

#include <cmath>

namespace tribo {

/// Compares the cell of each particle with that of the previous call and counts the changes. The first call only
/// stores the cells.
template <int Dim>
void count_crossings(Body<Dim>& body, const Lattice<Dim>& lattice) {
  if (!body.crossings) return;
  double* count = body.particles[body.crossings];
  double* cell = body.particles[body.cell_number];
  const auto x = body.particles.x();
  parallel_for(static_cast<std::ptrdiff_t>(body.particles.size()), [&](std::ptrdiff_t i) {
    double now = 0.0;  // the number of the cell, exact below 2^53
    for (std::size_t d = Dim; d-- > 0;) {
      const auto k = static_cast<Eigen::Index>(d);
      now = now * (lattice.blocks[d] * block_edge<Dim>)+std::floor((x[d][i] - lattice.origin[k]) / lattice.spacing[k]);
    }
    if (cell[i] >= 0 && cell[i] != now) count[i] += 1.0;
    cell[i] = now;
  });
}

}  // namespace tribo
