// SPDX-License-Identifier: MIT
/// How thick bodies are at the start.
#pragma once

#include "grid/lattice.hpp"
#include "model/model.hpp"
#include "particles/seeds.hpp"

#include <vector>

namespace tribo {

/// A body that is thin everywhere.
struct ThinBody {
  std::vector<int> pieces;  ///< the shapes that make it up, indices into Model::pieces
  double cells = 0.0;       ///< its thickness where it is thickest [cells]
};

/// The deformable bodies that are less than three cells thick, by a quarter of a cell at least. Shapes of one material
/// that touch or overlap are one body, also with their mirror images behind symmetry planes.
///
/// The thickness of a single shape is its least extent along the axes of the grid. Where shapes touch, it is the edge
/// of the largest cube (in the plane a square) within their union, to half a cell, or the thickness of the thickest of
/// them.
template <int Dim>
std::vector<ThinBody> thin_bodies(const Model& model, const Seeds& seeds, const Lattice<Dim>& lattice);

}  // namespace tribo
