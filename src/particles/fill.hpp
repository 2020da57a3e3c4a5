// SPDX-License-Identifier: MIT
/// Initial particles, generated from the shapes of the model.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace tribo {

/// Places particles in the shapes of the model: piece by piece, inside a piece in a fixed order (cells with x fastest,
/// then y, then z; within a cell likewise), then the single points, and finally the tables.
///
/// The surface of a shape cuts the cells of its outermost particles: these get the volume, the centroid and the surface
/// facets of the part inside (CutCell), so that the body has the volume and the faces of its shape.
///
/// Sites are at fractions (2k-1)/(2n) of the grid cells. A piece with a `point_size` has its own lattice, which starts
/// at the low corner of its bounding box, or where this enters the grid. Sites outside the grid are omitted. A site
/// belongs to the first piece or hole whose shape contains it, irrespective of the lattice of that piece. Pieces with
/// an initial deformation are independent: they neither occupy sites nor respect occupied ones. Velocities, stresses
/// and deformations are evaluated at the site at t = 0.
///
/// Throws InputError if a piece that is not a hole gets no particle, if det F <= 0, if r <= 0 in an axisymmetric model,
/// if a single or deformed particle lies outside the grid, or if the number of particles per cell is not a square (2D)
/// or cube (3D).
Seeds place_points(const Model& model);

/// Generates the same seeds without storing them: `receive` is called for each in order. The geostatic stress
/// (geostatic.hpp) is not included. `refuses_large`: throws InputError for a body whose particles would not fit into
/// the memory in a run.
void place_points(const Model& model, const std::function<void(const Seed&)>& receive, bool refuses_large = true);

/// Volume of the particles of a piece compared with that of its shape, for `tribo check`.
struct PlacedVolume {
  int piece = 0;
  long points = 0;
  double placed = 0.0;  ///< sum of the points' volumes [length^3; axisymmetric: per radian]
  /// Exact volume if known. It is not known for axisymmetric models, for pieces that may be cut by an earlier piece or
  /// by the edge of the grid, and for shapes without a closed form.
  std::optional<double> exact;
  /// placed / exact - 1, if the exact volume is known.
  std::optional<double> error() const {
    return exact && *exact > 0.0 ? std::optional(placed / *exact - 1.0) : std::nullopt;
  }
};

/// One entry for every piece that is not a hole, in order.
std::vector<PlacedVolume> volume_error(const Model& model, const Seeds& seeds);

}  // namespace tribo
