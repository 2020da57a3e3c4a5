// SPDX-License-Identifier: MIT
/// What a run will take: memory, files, time.
#pragma once

#include "run/remarks.hpp"
#include "solver/step.hpp"

namespace tribo {

/// Time and memory of a run, measured in some steps of size `dt` [time]. Bodies that will meet later are brought into
/// contact for a part of these steps, since contact may take most of the time. Afterwards the system is of no further
/// use.
template <int Dim>
Remarks describe_effort(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, double dt);

}  // namespace tribo
