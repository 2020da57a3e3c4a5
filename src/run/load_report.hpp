// SPDX-License-Identifier: MIT
/// The forces and tractions on particles, for the summary of a model.
#pragma once

#include "run/remarks.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// A line for each condition on particles: how many particles it acts on, and the largest total force until the end of
/// the run. Values are those at the initial positions; tractions act on the initial areas. Advice on tractions that act
/// inside a body.
template <int Dim>
Remarks describe_loads(const Model& model, System<Dim>& system);

}  // namespace tribo
