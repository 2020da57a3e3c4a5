// SPDX-License-Identifier: MIT
/// Energy and momentum that external actions add to and remove from the bodies during a run.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"

namespace tribo {

/// Work (first component) and impulse (the other three) of forces over a step [energy, momentum].
using WorkAndImpulse = Eigen::Vector4d;

/// Cumulative work and impulse since the start of the run. Nodal conditions and contact keep their own sums.
struct EnergyLedger {
  double external_work = 0.0;   ///< work of body forces, loads and tractions     [energy]
  double damping_work = 0.0;    ///< energy removed by damping, >= 0                   [energy]
  double rigid_work = 0.0;      ///< work of rigid particles                      [energy]
  Vec3 impulse = Vec3::Zero();  ///< impulse of all of these together                     [momentum]
};

inline void archive(Archive& a, EnergyLedger& ledger) {
  auto& [external_work, damping_work, rigid_work, impulse] = ledger;
  a.version(1);
  a("external_work", external_work), a("damping_work", damping_work);
  a("rigid_work", rigid_work), a("impulse", impulse);
}

}  // namespace tribo
