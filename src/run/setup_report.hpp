// SPDX-License-Identifier: MIT
/// The part of the pre-flight report on what acts on the bodies and between them.
#pragma once

#include "model/model.hpp"
#include "run/remarks.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Gravity, cells, conditions by edge of the grid, contact laws by pair of materials; bodies that overlap or that an
/// edge of the grid cuts. Of a system before the first step.
template <int Dim>
Remarks describe_setup(const Model& model, const System<Dim>& system);

}  // namespace tribo
