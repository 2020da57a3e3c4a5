// SPDX-License-Identifier: MIT
/// Sums over all particles, always added up in the same order: energies, momenta, means.
#pragma once

#include "solver/state/system.hpp"

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
  double work_heat = 0.0;                ///< dissipated work that became heat                   [energy]
  double heat = 0.0;                     ///< m c T                                              [energy]
  double temperature = 0.0;              ///< mean, weighted by heat capacity
  Mat3 stress = Mat3::Zero();            ///< volume average                                     [stress]
  Mat3 deformation = Mat3::Zero();       ///< volume average of F, zero if not kept
  Mat3 strain = Mat3::Zero();            ///< volume average of the Biot strain, if asked for and F is kept
  Vec3 low = Vec3::Constant(1e300);      ///< corners of the box around the particles' centres       [length]
  Vec3 high = Vec3::Constant(-1e300);
  double largest_speed = 0.0;       ///< of a component                                     [velocity]
  double largest_wave_speed = 0.0;  ///< in the present state                               [velocity]
  double least_volume_ratio = 0.0;  ///< of V / V0
};

template <int Dim>
Measures measure(Body<Dim>& body, bool strain = false);
/// Of one particle.
template <int Dim>
Measures measure_particle(Body<Dim>& body, std::size_t particle, bool strain);
/// Sum over bodies; means weighted by mass or volume.
template <int Dim>
Measures measure(System<Dim>& system, bool strain = false);

}  // namespace tribo
