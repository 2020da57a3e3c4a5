// SPDX-License-Identifier: MIT
/// The grid files; model/output_fields.cpp lists their fields.
#pragma once

#include "model/output_fields.hpp"
#include "solver/state/system.hpp"

#include <filesystem>

namespace tribo {

/// A node of the lattice with all velocity fields that have mass there; zero where none has. Several fields (bodies in
/// contact, the two sides of a crack) add up: masses and momenta.
template <int Dim>
GridNodeState grid_node_state(const System<Dim>& system, const Index<Dim>& node);

/// Writes the fields that the model asks for at all nodes of the grid as .vti. Throws FileError.
template <int Dim>
void write_grid_file(const std::filesystem::path& path, const Model& model, const System<Dim>& system);

}  // namespace tribo
