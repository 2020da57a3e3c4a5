// SPDX-License-Identifier: MIT
/// A particle at the start of the run.
#pragma once

#include "base/types.hpp"

#include <optional>

namespace tribo {

/// A material point at the start of the run.
struct Seed {
  Vec3 x = Vec3::Zero();          ///< position after any initial deformation                       [length]
  Vec3 v = Vec3::Zero();          ///< velocity                                                     [velocity]
  Vec3 half_size = Vec3::Zero();  ///< half extents of the undeformed domain along the grid axes    [length]
  /// Half axes of the undeformed domain as columns, where these are not along the grid axes [length].
  std::optional<Mat3> half_axes;
  Mat3 F = Mat3::Identity();   ///< initial deformation gradient                                 [-]
  Mat3 stress = Mat3::Zero();  ///< initial Cauchy stress                                        [stress]
  double volume = 0.0;         ///< before deformation; 2D: times thickness; axisymmetric: times r, per radian
  double mass = 0.0;           ///< density of its material times volume, unless prescribed
  double temperature = 0.0;
  double angle = 0.0;   ///< rotation of the material axes about z [rad]
  int material = 0;     ///< index into Model::materials
  int piece = -1;       ///< index into Model::pieces; -1: a single point of Model::points, or of a table
  int table = -1;       ///< index into Model::tables; -1: not of a table
  std::size_t row = 0;  ///< of the table

  bool operator==(const Seed&) const = default;
};

}  // namespace tribo
