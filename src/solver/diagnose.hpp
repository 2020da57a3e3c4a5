// SPDX-License-Identifier: MIT
/// Explains why a run cannot go on.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Throws SimulationError that names the first particle that left the grid, lost its volume or has a value that is not
/// a number, and says what helps. If no particle is at fault, a value on the grid is not a number.
template <int Dim>
[[noreturn]] void stop_at_bad_particle(const System<Dim>& system);

}  // namespace tribo
