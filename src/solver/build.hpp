// SPDX-License-Identifier: MIT
/// Construction of the state of a run from the model.
#pragma once

#include "particles/fill.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Creates the lattice, the velocity fields, one body per material with particles, rigid blocks, cracks and joints.
/// `seeds`: initial particles, from place_points(). Throws InputError if the model is not consistent.
template <int Dim>
System<Dim> build_system(const Model& model, Seeds seeds);

}  // namespace tribo
