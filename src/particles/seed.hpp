// SPDX-License-Identifier: MIT
/// Particles before the run: what the shapes of the model become.
#pragma once

#include "model/model.hpp"

#include <functional>
#include <vector>

namespace tribo {

/// One material point at the start.
struct Seed {
  Vec3 x = Vec3::Zero();          ///< position after any initial deformation                       [length]
  Vec3 v = Vec3::Zero();          ///<                                                              [velocity]
  Vec3 half_size = Vec3::Zero();  ///< of its domain before deformation, along the grid axes        [length]
  Mat3 F = Mat3::Identity();      ///< initial deformation gradient                                 [-]
  Mat3 stress = Mat3::Zero();     ///< initial Cauchy stress                                        [stress]
  double volume = 0.0;            ///< before deformation; 2D: times thickness; axisymmetric: times r, per radian
  double mass = 0.0;              ///< density of its material times volume, unless given
  double temperature = 0.0;
  double angle = 0.0;  ///< material axes about z                                                   [rad]
  int material = 0;    ///< index into Model::materials
  int piece = -1;      ///< index into Model::pieces; -1: a single point of Model::points
};

/// Fills the shapes of the model with points: piece by piece, inside a piece in a fixed order (cells x fastest, then y,
/// then z; sub-cells likewise), and at last the single points.
///
/// Sites are at cell fractions (2k-1)/(2n) of the grid's cells; a piece with a `point_size` has a lattice of its own
/// that starts at the low corner of its bounds, or where these enter the grid. Sites outside the grid are left out. A
/// site belongs to the first piece, or hole, whose shape contains it, whatever the lattice of that piece; pieces with a
/// deformation neither take sites nor look whether a site is taken. Velocities, stresses and deformations are evaluated
/// at the site, at t = 0.
///
/// Throws InputError if a piece that is not a hole gets no point, a point is inside out (det F <= 0) or on the wrong
/// side of the axis (axisymmetric, r <= 0), a single or deformed point lies outside the grid, or the number of points
/// per cell is not a square (2D) or cube (3D).
std::vector<Seed> place_points(const Model& model);

/// The same without keeping the seeds: `receive` is called for each of them in order, before anything adds the weight
/// of what lies above (geostatic.hpp).
void place_points(const Model& model, const std::function<void(const Seed&)>& receive);

/// What a piece was given, against its shape; for the pre-flight sheet.
struct PlacedVolume {
  int piece = 0;
  long points = 0;
  double placed = 0.0;  ///< sum of the points' volumes [length^3; axisymmetric: per radian]
  /// Exact volume, if it is known: not for axisymmetric analyses, nor where the piece may be cut by an earlier piece or
  /// by the edge of the grid, nor if its shape has no closed form.
  std::optional<double> exact;
  /// placed / exact - 1, if the exact volume is known.
  std::optional<double> error() const {
    return exact && *exact > 0.0 ? std::optional(placed / *exact - 1.0) : std::nullopt;
  }
};

/// One entry for every piece that is not a hole, in order.
std::vector<PlacedVolume> volume_error(const Model& model, const std::vector<Seed>& seeds);

}  // namespace tribo
