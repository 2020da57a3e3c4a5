// SPDX-License-Identifier: MIT
/// From the model to what a step works on.
#pragma once

#include "particles/seed.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Lattice, one velocity field, one body per material that has particles. `seeds` from place_points.
/// Throws InputError if the model cannot run.
template <int Dim>
System<Dim> build_system(const Model& model, const std::vector<Seed>& seeds);

}  // namespace tribo
