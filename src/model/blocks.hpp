// SPDX-License-Identifier: MIT
/// Assemblies of rigid blocks as the user described them, in consistent units.
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

/// A function of time.
struct TimeFunction {
  Expression of;
  double time = 1.0;   ///< consistent time of one unit of the function's t
  double scale = 1.0;  ///< consistent units of its value
  double at(double t) const {
    Variables v;
    v.t = t / time;
    return scale * of(v);
  }
};

/// Blocks with something in common: the cells of one tessellation, or a single block.
struct BlockGroup {
  enum class Shape { voronoi, polygon, brick, ball } shape = Shape::brick;
  std::string name;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box of a tessellation or brick
  std::vector<Vec3> points;                      ///< nuclei of a tessellation, corners of a polygon, centre of a ball
  std::vector<Origin> point_origins;             ///< where they were written
  double radius = 0.0;                           ///< of a ball
  double angle = 0.0;                            ///< polygon, brick: turned about z around the origin [rad]
  double density = 1.0;
  int material = -1;  ///< beside a grid: what others touch, index into Model::materials
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
  Origin origin;
};

/// Law of the contacts whose middle lies in a region; the first that fits is taken.
struct BlockJoint {
  RegionPtr where;
  std::shared_ptr<const JointLaw> law;
  bool corners = false;  ///< a contact at every corner of a face, with its share of the area; else one at the middle
  Origin origin;
};

/// A stiff plate on the free faces whose middles lie in a region.
struct BlockPlaten {
  std::string name;
  RegionPtr where;
  std::array<std::optional<TimeFunction>, 3> velocity;  ///< not given: zero
  bool rough = false;                                   ///< holds the faces along the plate, too
  double modulus = 0.0;  ///< E of its springs E A/d; 0: the normal stiffness of the blocks' law
  Origin origin;
};

/// Pressure on the free faces whose middles lie in a region.
struct BlockPressure {
  RegionPtr where;
  TimeFunction pressure;
  bool follows = true;  ///< the faces as they turn; else their normals at the start
  Origin origin;
};

/// Prescribed motion of the blocks whose centres lie in a region.
struct BlockHold {
  RegionPtr where;
  std::array<std::optional<TimeFunction>, 3> velocity, spin;  ///< not given: free
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
  std::string name;    ///< of a quantity, see block_quantities()
  std::string column;  ///< column head
  int platen = -1;     ///< index, or
  int group = -1;      ///< of blocks; -1 both: of the run
};

struct BlocksSpec {
  bool in_grid = false;  ///< beside a grid with particles
  std::vector<BlockGroup> groups;
  std::vector<BlockJoint> joints;
  std::vector<BlockPlaten> platens;
  std::vector<BlockPressure> pressures;
  std::vector<BlockHold> holds;
  std::vector<BlockLoad> loads;
  std::shared_ptr<const JointLaw> law;    ///< of contacts that no joint names
  bool corners = false;                   ///< as BlockJoint::corners, for `law`
  std::shared_ptr<const JointLaw> touch;  ///< of contacts that come about later; null: they are an error
  double thickness = 1.0;                 ///< of two dimensions
  double local_damping = 0.0;             ///< alpha: forces are lessened by alpha |F| against the velocity
  int stress_iterations = 0;              ///< of the fictitious stress, within a step
  bool quasi_static = false;              ///< masses are chosen so that the step is as long as it is asked to be
  double step_share = 0.8;                ///< of the critical step
  std::vector<BlockHistory> histories;
  Origin origin;
};

}  // namespace tribo
