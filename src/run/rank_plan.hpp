// SPDX-License-Identifier: MIT
/// How several processes would share a model: planned in a single one.
#pragma once

#include "grid/lattice.hpp"
#include "model/model.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tribo {

/// What a process would have.
struct RankShare {
  std::int64_t particles = 0;  ///< that it updates
  std::int64_t blocks = 0;     ///< with particles
  std::int64_t ghosts = 0;     ///< copies of particles of others
  std::int64_t sent = 0;       ///< its particles times the processes that have a copy
  std::int64_t partners = 0;   ///< processes with which it exchanges values
};

/// Particles in the blocks of a lattice: (lattice index, number), in ascending order.
using BlockCounts = std::vector<std::pair<std::int64_t, std::int64_t>>;

/// Divides the blocks along the Morton curve into parts with about equal numbers of particles, as p4est does, and
/// counts what each rank then has. `layers`: of ghost blocks; `common`: blocks around which every rank has copies, see
/// find_common_blocks().
template <int Dim>
std::vector<RankShare> share_of_ranks(const Lattice<Dim>& lattice, const BlockCounts& blocks, int ranks, int layers,
                                      const std::vector<std::int64_t>& common = {});

/// The largest number of particles of a rank over the mean.
double imbalance(const std::vector<RankShare>& shares);

/// A report of the division of a model among processes with so many threads each: particles, copies, messages, memory
/// and modelled efficiency. Throws InputError.
std::string plan_for_ranks(const Model& model, int ranks, int threads);

}  // namespace tribo
