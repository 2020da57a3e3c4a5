// SPDX-License-Identifier: MIT
/// Energy and momentum that external actions add to and remove from the bodies during a run.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"

namespace tribo {

/// Work (first component) and impulse (the other three) of forces over a step [energy, momentum].
using WorkAndImpulse = Eigen::Vector4d;

/// Cumulative work and impulse since the start of the run. Nodal conditions and contact keep their own sums.
///
/// The transfers between particles and nodes change the kinetic energy without a force. What they dissipate is the
/// difference between the work of all forces at the nodes and the change of the kinetic energy of the particles.
struct EnergyLedger {
  double external_work = 0.0;   ///< work of body forces, loads and tractions     [energy]
  double damping_work = 0.0;    ///< energy removed by damping, >= 0                   [energy]
  double rigid_work = 0.0;      ///< work of rigid particles                      [energy]
  Vec3 impulse = Vec3::Zero();  ///< impulse of all of these together                     [momentum]
  double nodal_work = 0.0;      ///< work of all forces at the nodes, internal ones included [energy]
  double particle_loss = 0.0;   ///< kinetic energy taken from particles directly: damping, merging [energy]
  double first_kinetic = 0.0;   ///< kinetic energy of the particles before the first step [energy]
  bool started = false;         ///< whether a step was taken
  double stages = 0.0;          ///< brought by stages, negative: taken away      [energy]

  /// Kinetic energy lost in the transfers so far; negative: gained. `kinetic`: of the particles now.
  double transfer_loss(double kinetic) const {
    return started ? nodal_work - particle_loss - (kinetic - first_kinetic) : 0.0;
  }
};

inline void archive(Archive& a, EnergyLedger& ledger) {
  auto& [external_work, damping_work, rigid_work, impulse, nodal_work, particle_loss, first_kinetic, started, stages] =
      ledger;
  a.version(3);
  a("external_work", external_work), a("damping_work", damping_work);
  a("rigid_work", rigid_work), a("impulse", impulse);
  a("nodal_work", nodal_work), a("particle_loss", particle_loss);
  a("first_kinetic", first_kinetic), a("started", started);
  a("stages", stages);
}

}  // namespace tribo
