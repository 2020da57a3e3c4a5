// SPDX-License-Identifier: MIT
/// What a model has besides particles and blocks, as drawings for the page of `tribo view`.
#pragma once

#include "blocks/assembly.hpp"
#include "model/model.hpp"
#include "solver/state/system.hpp"

#include <string>

namespace tribo {

/// The layers as JSON: a list of names, notes, colours, points, lines and polygons. Grid, symmetry planes, walls,
/// periodic edges, prescribed velocities and temperatures of nodes, loads on particles, cracks, joints and gravity.
template <int Dim>
std::string model_layers(const Model& model, const System<Dim>& system);

/// The same of a model of blocks alone: where blocks are held and loaded.
std::string model_layers(const Model& model, const Assembly& blocks);

}  // namespace tribo
