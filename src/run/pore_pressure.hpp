// SPDX-License-Identifier: MIT
/// Joints that the pressure of their pore fluid tears at once.
#pragma once

#include "blocks/assembly.hpp"
#include "solver/state/system.hpp"

#include <string>

namespace tribo {

/// A sentence about the joints that tear in the first step although nothing moves, because a pore pressure acts on
/// joints without stress, and what to do about it; empty if there are none.
template <int Dim>
std::string torn_by_pressure(const System<Dim>& system);
std::string torn_by_pressure(const Assembly& blocks);

}  // namespace tribo
