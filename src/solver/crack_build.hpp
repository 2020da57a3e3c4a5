/// Cracks and their joints before the first step.
#pragma once

#include "solver/system.hpp"

namespace tribo {

/// Puts the model's cracks, with the points of their joints, into a system whose bodies are there. `width`: nodes of a
/// stencil along an axis. Throws InputError for a joint outside of all bodies.
template <int Dim>
void add_cracks(const Model& model, System<Dim>& system, int width);

}  // namespace tribo
