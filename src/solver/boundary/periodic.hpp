// SPDX-License-Identifier: MIT
/// Periodic axes: particles that leave the grid, and the blocks at the edges. EdgeExchange treats the nodes.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Moves particles beyond an edge of a periodic axis by whole periods back into the grid. Their initial positions are
/// moved equally, so that displacements remain continuous.
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

/// Adds the blocks at both edges of a periodic axis to the list of blocks with particles if there are particles near
/// one of the edges. The nodes that receive sums across the edge then exist.
template <int Dim>
void add_periodic_blocks(const GridSpec& grid, const Lattice<Dim>& lattice, std::vector<BlockReach<Dim>>& blocks) {
  for (std::size_t d = 0; d < Dim; ++d) {
    if (!grid.periodic[d]) continue;
    const int low = Lattice<Dim>::padding / block_edge<Dim>;
    const int high = (Lattice<Dim>::padding + grid.cells[d]) / block_edge<Dim>;
    for (std::size_t k = 0, count = blocks.size(); k < count; ++k) {
      auto block = lattice.block_at(blocks[k].block);
      if (std::abs(block[d] - low) > 1 && std::abs(block[d] - high) > 1) continue;
      for (const int edge : {low, high})
        block[d] = edge, blocks.push_back(BlockReach<Dim>::full(lattice.block_index(block)));
    }
  }
}

}  // namespace tribo
