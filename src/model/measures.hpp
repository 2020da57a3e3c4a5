// SPDX-License-Identifier: MIT
/// Sums that histories are computed from.
#pragma once

#include "base/types.hpp"

#include <cstdint>

namespace tribo {

/// Mechanical content of one body or of all of them.
struct Measures {
  double mass = 0.0, volume = 0.0;
  std::int64_t particles = 0;
  Vec3 momentum = Vec3::Zero();          ///< [mass velocity]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin, affine part of APIC included
  Vec3 centre = Vec3::Zero();            ///< of mass                                            [length]
  Vec3 displacement = Vec3::Zero();      ///< mass average                                       [length]
  double kinetic = 0.0;                  ///< [energy]
  double stored = 0.0;                   ///< elastic                                            [energy]
  double dissipated = 0.0;               ///< by the material                                    [energy]
  double expansion = 0.0;                ///< work of the stress on thermal expansion                [energy]
  double work_heat = 0.0;                ///< dissipated work that became heat                   [energy]
  double heat = 0.0;                     ///< m c T                                              [energy]
  double temperature = 0.0;              ///< mean, weighted by heat capacity, or by mass without one
  double weighted_temperature = 0.0;     ///< its sum before the division by the weights
  Mat3 stress = Mat3::Zero();            ///< volume average                                     [stress]
  Mat3 deformation = Mat3::Zero();       ///< volume average of F, zero if not kept
  Mat3 strain = Mat3::Zero();            ///< volume average of the Biot strain, if asked for and F is kept
  Mat3 elastic = Mat3::Zero();           ///< volume average of the elastic strain, if a history asks for it
  double variable = 0.0;                 ///< volume average of the history variable that a history asks for
  Vec3 low = Vec3::Constant(1e300);      ///< corners of the box around the particles' centres       [length]
  Vec3 high = Vec3::Constant(-1e300);
  double largest_speed = 0.0;       ///< of a component                                     [velocity]
  double largest_wave_speed = 0.0;  ///< in the present state                               [velocity]
  double least_volume_ratio = 0.0;  ///< of V / V0
};

/// Energies of a run that no sum over particles contains [energy].
struct RunEnergies {
  double potential = 0.0;       ///< of constant gravity, zero at the start
  double external_work = 0.0;   ///< of body forces as functions, and of loads
  double boundary_work = 0.0;   ///< of prescribed velocities and rigid particles
  double stages = 0.0;          ///< brought by stages of the run; negative: taken away
  double damping = 0.0;         ///< taken out
  double transfer = 0.0;        ///< kinetic energy lost in the transfers between particles and nodes; negative: gained
  double contact = 0.0;         ///< dissipated by contact
  double interface = 0.0;       ///< stored in imperfect interfaces and joints
  double joint_strain = 0.0;    ///< stored in joints
  double joint_slip = 0.0;      ///< dissipated by friction in joints
  double joint_dashpot = 0.0;   ///< dissipated by dashpots of joints
  double joint_released = 0.0;  ///< released by brittle failure, dilation and changes of pressure in joints
  double decohesion = 0.0;      ///< dissipated by cohesive zones
  double grid_kinetic = 0.0;    ///< kinetic energy of the nodes at the end of the last step
};

/// Contact of one pair of materials, or the sum over pairs.
struct ContactSums {
  Vec3 force = Vec3::Zero();                          ///< on the material, mean since the last row  [force]
  Vec3 last_force = Vec3::Zero();                     ///< on the material, in the last step         [force]
  double friction = 0.0, impact = 0.0, stored = 0.0;  ///< see PairLedger           [energy]
  double area = 0.0;                                  ///< of the faces in contact  [length^2]
};

}  // namespace tribo
