/// Particles before the run: what the shapes of the model become.
#pragma once

#include "model/model.hpp"

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

/// Fills the shapes of the model with points, in a fixed order (cells x fastest, then y, then z; sub-cells likewise).
/// Sites are at cell fractions (2k-1)/(2n); a site belongs to the first piece whose shape contains it.
/// Throws InputError if a piece that is not a hole gets no point, or a single point lies outside the grid.
std::vector<Seed> place_points(const Model& model);

}  // namespace tribo
