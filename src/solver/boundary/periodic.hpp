// SPDX-License-Identifier: MIT
/// Grids whose two edges along an axis are one. The nodes' part is in conditions.hpp.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Moves particles beyond an edge of a periodic axis in through the other, and the positions they started from with
/// them, so that displacements go on growing.
template <int Dim>
void return_through_period(const GridSpec& grid, const Lattice<Dim>& lattice, Body<Dim>& body) {
  const auto x = body.particles.x();
  for (std::size_t d = 0; d < Dim; ++d) {
    if (!grid.periodic[d]) continue;
    const auto axis = static_cast<Eigen::Index>(d);
    const double low = lattice.low[axis], period = lattice.high[axis] - low;
    double* from = body.origin ? body.particles[body.origin][d] : nullptr;
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const double shift = period * std::floor((x[d][i] - low) / period);
      if (shift == 0.0 || !std::isfinite(shift)) continue;
      x[d][i] -= shift;
      if (from) from[i] -= shift;
    }
  }
}

/// Adds to the blocks with particles those at both edges of a periodic axis, if there are particles at one of them:
/// what is scattered across an edge then finds its nodes.
template <int Dim>
void add_periodic_blocks(const GridSpec& grid, const Lattice<Dim>& lattice, std::vector<std::int64_t>& blocks) {
  for (std::size_t d = 0; d < Dim; ++d) {
    if (!grid.periodic[d]) continue;
    const int low = Lattice<Dim>::padding / block_edge<Dim>;
    const int high = (Lattice<Dim>::padding + grid.cells[d]) / block_edge<Dim>;
    for (std::size_t k = 0, count = blocks.size(); k < count; ++k) {
      auto block = lattice.block_at(blocks[k]);
      if (std::abs(block[d] - low) > 1 && std::abs(block[d] - high) > 1) continue;
      for (const int edge : {low, high}) block[d] = edge, blocks.push_back(lattice.block_index(block));
    }
  }
}

}  // namespace tribo
