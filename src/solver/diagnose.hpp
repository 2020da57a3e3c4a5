// SPDX-License-Identifier: MIT
/// Error messages for runs that cannot continue.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Throws a SimulationError that names the first particle outside of the grid, without a positive volume or with a
/// value that is not finite, and suggests remedies. If there is no such particle, it reports that a nodal value is not
/// finite.
template <int Dim>
[[noreturn]] void stop_at_bad_particle(const System<Dim>& system);

}  // namespace tribo
