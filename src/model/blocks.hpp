// SPDX-License-Identifier: MIT
/// Input description of an assembly of rigid blocks, in consistent units.
#pragma once

#include "base/expression.hpp"
#include "base/statement.hpp"
#include "geometry/region.hpp"

#include <array>
#include <cstdint>
#include <map>
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

/// The laws of contacts between blocks.
struct BlockLaws {
  std::shared_ptr<const JointLaw> initial;  ///< of contacts that exist at the start; null: they are an error
  std::shared_ptr<const JointLaw> later;    ///< of contacts formed during the run; null: they are an error
  /// With inheritance: both laws with the surface properties of two groups, smaller index first.
  std::map<std::array<std::int32_t, 2>, std::array<std::shared_ptr<const JointLaw>, 2>> by_groups;
  const JointLaw* initial_of(std::array<std::int32_t, 2> groups) const { return of(groups, 0, initial); }
  const JointLaw* later_of(std::array<std::int32_t, 2> groups) const { return of(groups, 1, later); }

 private:
  const JointLaw* of(std::array<std::int32_t, 2> groups, std::size_t which,
                     const std::shared_ptr<const JointLaw>& otherwise) const {
    if (groups[1] < groups[0]) std::swap(groups[0], groups[1]);
    const auto found = by_groups.find(groups);
    return (found == by_groups.end() ? otherwise : found->second[which]).get();
  }
};

/// A contact between two blocks, as the rules for its law see it.
struct BlockPairing {
  enum class Kind { faces, balls, ball_on_face };
  std::array<std::int32_t, 2> groups{};  ///< of the two blocks, indices into BlocksSpec::groups
  Vec3 place = Vec3::Zero(), normal = Vec3::UnitX();
  Kind kind = Kind::faces;
  bool later = false;  ///< it forms during the run
};

/// A rule that assigns laws to the contacts that fulfil all its criteria.
struct BlockJoint {
  RegionPtr where;  ///< contains the place of the contact; null: anywhere
  /// Groups of the one block and of the other; empty: any.
  std::array<std::vector<std::int32_t>, 2> groups;
  /// Ranges of the angle between the face and the horizontal, and of the direction in which it descends: clockwise
  /// from y as seen from above, in two dimensions 90 degrees to the right and 270 to the left. If the first limit is
  /// larger, the range contains north [rad].
  std::optional<std::array<double, 2>> dip, dip_direction;
  std::optional<BlockPairing::Kind> kind;
  bool at_start = true, later = false;  ///< whether contacts that exist at the start, or form later, are meant
  BlockLaws laws;
  bool corners =
      false;  ///< true: one contact at each corner of a face with its share of the area; false: one at the centre
  Origin origin;
  /// `plane`: two dimensions, in which y points up; else z does.
  bool fits(const BlockPairing& contact, bool plane) const;
};

/// A stiff platen bonded to the free faces whose centres lie in a region.
struct BlockPlaten {
  std::string name;
  RegionPtr where;
  std::array<std::optional<TimeFunction>, 3> velocity;  ///< absent: zero
  bool rough = false;                                   ///< also resists tangential motion of the faces
  double modulus = 0.0;  ///< E of its springs of stiffness E A/d; 0: the normal stiffness of BlocksSpec::laws
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
  RegionPtr where;                                            ///< null: anywhere
  std::array<std::optional<TimeFunction>, 3> velocity, spin;  ///< absent components are free
  Origin origin;
  std::vector<std::int32_t> groups = {};  ///< of the blocks, indices into BlocksSpec::groups; empty: any
};

/// Force and moment on each block of some groups whose centre lies in a region.
struct BlockLoad {
  RegionPtr where;  ///< null: anywhere
  std::array<std::optional<TimeFunction>, 3> force, moment;
  Origin origin;
  std::vector<std::int32_t> groups = {};  ///< of the blocks, indices into BlocksSpec::groups; empty: any
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
  std::vector<BlockJoint> joints;  ///< the first that fits a contact determines its laws
  std::vector<BlockPlaten> platens;
  std::vector<BlockPressure> pressures;
  std::vector<BlockHold> holds;
  std::vector<BlockLoad> loads;
  BlockLaws laws;              ///< of contacts that none of `joints` fits
  bool corners = false;        ///< as BlockJoint::corners, for `laws`
  double thickness = 1.0;      ///< out of plane, in two dimensions
  double local_damping = 0.0;  ///< alpha: a force of magnitude alpha |F| acts against the velocity
  int stress_iterations = 0;   ///< fixed-point iterations of the fictitious stress within a step
  bool quasi_static = false;   ///< masses are scaled so that the given time step is stable
  double step_share = 0.8;     ///< fraction of the critical time step
  std::vector<BlockHistory> histories;
  Origin origin;

  /// Index of the first rule that fits a contact; the number of rules if none does.
  std::size_t rule(const BlockPairing& contact, bool plane) const;
  /// The laws that belong to a result of rule().
  const BlockLaws& laws_of(std::size_t rule) const { return rule < joints.size() ? joints[rule].laws : laws; }
};

}  // namespace tribo
