// SPDX-License-Identifier: MIT
/// The columns of ghosts that must have the present values of their particles.
#pragma once

#include "solver/state/system.hpp"

#include <cstddef>
#include <vector>

namespace tribo {

/// The numbers of all columns of a body that change between two sorts.
template <int Dim>
std::vector<std::size_t> changing_columns(const Body<Dim>& body);

/// Whether more than scatters reads the ghosts of a model: contact, cracks, and loads on faces.
template <int Dim>
bool reads_whole_ghosts(const Model& model, const System<Dim>& system);

}  // namespace tribo
