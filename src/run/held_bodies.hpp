// SPDX-License-Identifier: MIT
/// What holds the bodies of a model.
#pragma once

#include "particles/seeds.hpp"
#include "run/remarks.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Bodies at nodes that are fixed in all directions, which contact cannot move there, and bodies that nothing holds
/// under gravity.
template <int Dim>
Remarks describe_holds(const Model& model, const System<Dim>& system, const Seeds& seeds);

}  // namespace tribo
