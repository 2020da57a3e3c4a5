// SPDX-License-Identifier: MIT
/// Particles that stages of a run place.
#pragma once

#include "particles/seed.hpp"
#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// A particle that a stage places.
struct LaterSeed {
  Seed seed;
  int stage = 0;  ///< from 1
};

/// All of them, in the order of the stages. Each stage fills its shapes as if there were nothing else.
std::vector<LaterSeed> later_seeds(const Model& model);

/// Removes the particles from number `present` on, whose stages are `stages`, from a body that is to be added to the
/// system. Those of the stage of the model are kept in System::placed. All models of a run are built with all particles
/// in this way, so that bodies, fields and columns are the same in all stages.
template <int Dim>
void set_aside(const Model& model, Body<Dim>& body, std::size_t present, const std::vector<int>& stages,
               System<Dim>& system);

}  // namespace tribo
