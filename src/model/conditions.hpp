// SPDX-License-Identifier: MIT
/// Loads, and conditions on grid nodes.
#pragma once

#include "base/expression.hpp"
#include "geometry/region.hpp"
#include "model/prescribed.hpp"

#include <array>
#include <functional>
#include <optional>
#include <span>

namespace tribo {

/// Axis or relative direction of a load on particles.
enum class LoadDirection {
  x = 0,
  y = 1,
  z = 2,
  normal,     ///< outward normal of the face; tractions only
  tangential  ///< normal rotated by 90 degrees about z, counterclockwise; tractions in two dimensions only
};

/// Face of a particle's domain, numbered as in command files.
enum class DomainFace { low_y = 1, high_x = 2, high_y = 3, low_x = 4, low_z = 5, high_z = 6 };

/// A wall normal to an axis that moves through the grid. It starts in a plane of nodes and prescribes the velocity
/// along its normal on the nodes near its present place: v + g (x - s), with v the velocity of the wall, s its place
/// and g the velocity gradient at the wall.
struct MovingWall {
  int side = 1;        ///< 1: the material lies at smaller coordinates; -1: at larger ones
  double depth = 0.0;  ///< nodes within this distance on the side of the material are governed, too [cells]
  Expression displacement, gradient;
  bool mirror = false;                            ///< the gradient is that of the velocities of the last two free nodes
  double function_time = 1.0;                     ///< consistent time of one unit of t in the functions
  double length_unit = 1.0, gradient_unit = 1.0;  ///< factors of the values of the functions to consistent units
};

/// Prescribed velocity of grid nodes in a region.
struct NodeCondition {
  RegionPtr where;                 ///< of the nodes, or for a wall of the nodes where it starts
  Vec3 direction = Vec3::UnitX();  ///< unit vector of the prescribed component
  Prescribed velocity;
  std::optional<MovingWall> wall;
  int id = 0;  ///< identifies the condition in reaction histories, <= 0
  Origin origin;
};

/// Force on particles in a region, or traction or heat flux on a face of their domains. A positive normal traction is
/// tensile; a positive heat flux heats the particles.
struct ParticleCondition {
  enum class Kind { force, traction, heat_flux } kind = Kind::force;
  RegionPtr where;
  LoadDirection direction = LoadDirection::x;
  DomainFace face = DomainFace::low_y;  ///< traction and heat flux
  bool net = false;                     ///< the force is a total, divided among the particles found
  Prescribed value;
  Origin origin;
};

/// Accelerations that a program computes for all particles of the deformable bodies at once: from their positions and
/// the time, `dimension` numbers per particle next to each other, in the order of bodies and particles.
using ParticleAccelerations =
    std::function<void(int dimension, std::span<const double> positions, double time, std::span<double> accelerations)>;

struct BodyForce {
  Vec3 gravity = Vec3::Zero();
  std::array<std::optional<Expression>, 3> function;      ///< acceleration f(x, y, z, t) of grid nodes
  std::array<std::optional<Expression>, 3> on_particles;  ///< acceleration of particles, also depends on x0, y0, z0
  ParticleAccelerations of_program = {};                  ///< called once per step; empty: none
  bool acts_on_particles() const { return on_particles[0] || on_particles[1] || on_particles[2] || of_program; }
  double function_time = 1.0;
};

}  // namespace tribo
