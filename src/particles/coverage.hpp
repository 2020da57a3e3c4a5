// SPDX-License-Identifier: MIT
/// What shapes of a model have in common with each other and with the outside of the grid.
#pragma once

#include "model/model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// A body that an edge of the grid cuts, so that it gets no particles beyond it.
struct EdgeCut {
  int piece = 0;  ///< index into Model::pieces
  int axis = 0;
  int side = 0;       ///< 0: low end of the axis, 1: high end
  double lost = 0.0;  ///< fraction of its volume outside the grid, all edges together
};

/// The bodies that edges of the grid cut, in order. Symmetry planes and periodic edges may cut bodies, since these
/// continue on the other side. Shapes are sampled at points, a few per cell just outside of each edge; what
/// holes and earlier bodies cover is not lost.
std::vector<EdgeCut> edge_cuts(const Model& model);
/// The same of one piece, the first cut only.
std::vector<EdgeCut> edge_cuts(const Model& model, std::size_t piece);
/// A sentence on a cut: "the edge of the grid at xmax = 4 cuts this body: 40 % of it lies outside".
std::string text_of(const EdgeCut& cut, const Model& model);

/// A sentence on a body that has particles beyond a symmetry plane, where only mirror images may be: "this body has
/// parts beyond the symmetry plane at xmax = 1, up to x = 4"; none if it has not. The part of the grid beyond a plane
/// is sampled at points.
std::optional<std::string> part_beyond_plane(const Model& model, std::size_t piece);

/// Two bodies that claim the same place, which the first one gets.
struct Overlap {
  int first = 0, second = 0;  ///< indices into Model::pieces
  double volume = 0.0;        ///< of their common part [length^3, in two dimensions length^2]
  /// The first lies in the second, as an inclusion in its matrix does.
  bool inside = false;
};

/// The pairs of bodies that overlap by more than a tenth of a cell, in order; bodies of one material with the same
/// initial velocity are one body. Bodies with an initial deformation and holes are left out. The shapes are sampled at
/// points.
std::vector<Overlap> overlaps(const Model& model);

}  // namespace tribo
