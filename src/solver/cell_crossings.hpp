// SPDX-License-Identifier: MIT
/// Counts how often particles move to another cell of the grid, if the output contains this quantity.
#pragma once

#include "base/parallel.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Compares the cell of each particle with that of the previous call and counts the changes. The first call only
/// stores the cells.
template <int Dim>
void count_crossings(Body<Dim>& body, const Lattice<Dim>& lattice) {
  if (!body.crossings) return;
  double* count = body.particles[body.crossings];
  double* cell = body.particles[body.cell_number];
  parallel_for(static_cast<std::ptrdiff_t>(body.particles.size()), [&](std::ptrdiff_t i) {
    // exact below 2^53
    const auto now = static_cast<double>(lattice.cell_number(body.particles.position(static_cast<std::size_t>(i))));
    if (cell[i] >= 0 && cell[i] != now) count[i] += 1.0;
    cell[i] = now;
  });
}

}  // namespace tribo
