// SPDX-License-Identifier: MIT
/// The blocks around which every process of a run knows all particles.
///
/// What the faces of contact, cracks, joints and rigid blocks do to the nodes near one place may depend on what they do
/// far away, and is computed in a fixed order. Every process therefore computes it for all of them, from the same
/// nodes, and finds the same bits.
#pragma once

#include "solver/state/system.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// The bins of a body that a process knows, those of ghosts included.
template <int Dim>
struct KnownBins {
  const Body<Dim>* body = nullptr;
  std::vector<BinContent<Dim>> bins;
};

/// Whether a model may have such blocks.
template <int Dim>
bool has_common_blocks(const Model& model, const System<Dim>& system);

/// The blocks whose nodes every process needs until the next sort, as lattice indices in ascending order. `width`:
/// number of nodes of a stencil along an axis. All ranks must call it together.
template <int Dim>
std::vector<std::int64_t> find_common_blocks(const Model& model, const System<Dim>& system, int width,
                                             const std::vector<KnownBins<Dim>>& bodies);

}  // namespace tribo
