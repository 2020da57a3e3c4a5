// SPDX-License-Identifier: MIT
/// Particles that come later: those that stages of a run place, and the rows that enter at sources.
#pragma once

#include "particles/fill.hpp"
#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// A particle that comes later.
struct LaterSeed {
  Seed seed;
  int stage = 0;  ///< that places it, from 1; -1, -2, ...: it belongs to the row of source 0, 1, ...
};

/// All of them, in the order of the stages, then of the sources. Each stage fills its shapes as if there were nothing
/// else.
std::vector<LaterSeed> later_seeds(const Model& model);

/// Removes the particles from number `present` on, whose stages are `stages`, from a body that is to be added to the
/// system. Those of the stage of the model are kept in System::placed, rows of sources in System::inflow. All models of
/// a run are built with all particles in this way, so that bodies, fields and columns are the same in all stages.
template <int Dim>
void set_aside(const Model& model, Body<Dim>& body, std::size_t present, const std::vector<int>& stages,
               System<Dim>& system);

}  // namespace tribo
