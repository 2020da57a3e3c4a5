// SPDX-License-Identifier: MIT
/// Input description of an assembly of rigid blocks, in consistent units.
#pragma once

#include "base/expression.hpp"
#include "base/statement.hpp"
#include "geometry/region.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

class JointLaw;

/// A prescribed function of time.
struct TimeFunction {
  Expression of;
  double time = 1.0;   ///< consistent time of one unit of the function's argument t
  double scale = 1.0;  ///< factor of the function's value to consistent units
  double at(double t) const {
    Variables v;
    v.t = t / time;
    return scale * of(v);
  }
};

/// Blocks with common properties: the cells of one tessellation, or a single block.
struct BlockGroup {
  enum class Shape { voronoi, polygon, brick, ball } shape = Shape::brick;
  std::string name;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box of a tessellation or brick
  std::vector<Vec3> points;                      ///< nuclei of a tessellation, corners of a polygon, centre of a ball
  std::vector<Origin> point_origins;             ///< their places in the input
  double radius = 0.0;                           ///< of a ball
  double angle = 0.0;                            ///< polygon, brick: rotation about the z axis through the origin [rad]
  double density = 1.0;
  int material = -1;  ///< with a grid: RigidContact material of the blocks, index into Model::materials
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
  Origin origin;
};

/// Joint law of the contacts whose centre lies in a region. The first joint whose region contains the centre applies.
struct BlockJoint {
  RegionPtr where;
  std::shared_ptr<const JointLaw> law;
  bool corners =
      false;  ///< true: one contact at each corner of a face with its share of the area; false: one at the centre
  Origin origin;
};

/// A stiff platen bonded to the free faces whose centres lie in a region.
struct BlockPlaten {
  std::string name;
  RegionPtr where;
  std::array<std::optional<TimeFunction>, 3> velocity;  ///< absent: zero
  bool rough = false;                                   ///< also resists tangential motion of the faces
  double modulus = 0.0;  ///< E of its springs of stiffness E A/d; 0: the normal stiffness of BlocksSpec::law
  Origin origin;
};

/// Pressure on the free faces whose centres lie in a region.
struct BlockPressure {
  RegionPtr where;
  TimeFunction pressure;
  bool follows = true;  ///< true: normal to the rotating faces; false: along their initial normals
  Origin origin;
};

/// Prescribed motion of the blocks whose centres lie in a region.
struct BlockHold {
  RegionPtr where;
  std::array<std::optional<TimeFunction>, 3> velocity, spin;  ///< absent components are free
  Origin origin;
};

/// Force and moment on each block whose centre lies in a region.
struct BlockLoad {
  RegionPtr where;
  std::array<std::optional<TimeFunction>, 3> force, moment;
  Origin origin;
};

/// A column of history.csv.
struct BlockHistory {
  std::string name;    ///< name in block_quantities()
  std::string column;  ///< column head
  int platen = -1;     ///< index of a platen; -1: none
  int group = -1;      ///< index of a block group; -1: none. Both -1: quantity of the whole run
};

struct BlocksSpec {
  bool in_grid = false;  ///< coupled to a grid with particles
  std::vector<BlockGroup> groups;
  std::vector<BlockJoint> joints;
  std::vector<BlockPlaten> platens;
  std::vector<BlockPressure> pressures;
  std::vector<BlockHold> holds;
  std::vector<BlockLoad> loads;
  std::shared_ptr<const JointLaw> law;  ///< joint law of contacts outside all `joints`
  bool corners = false;                 ///< as BlockJoint::corners, for `law`
  std::shared_ptr<const JointLaw>
      touch;                   ///< joint law of contacts formed during the run; null: such contacts are an error
  double thickness = 1.0;      ///< out of plane, in two dimensions
  double local_damping = 0.0;  ///< alpha: a force of magnitude alpha |F| acts against the velocity
  int stress_iterations = 0;   ///< fixed-point iterations of the fictitious stress within a step
  bool quasi_static = false;   ///< masses are scaled so that the given time step is stable
  double step_share = 0.8;     ///< fraction of the critical time step
  std::vector<BlockHistory> histories;
  Origin origin;
};

}  // namespace tribo
