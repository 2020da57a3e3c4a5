// SPDX-License-Identifier: MIT
/// Energy and momentum that enter and leave the bodies during a run.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"

namespace tribo {

/// Work (first component) and impulse (the other three) of forces over a step [energy, momentum].
using WorkAndImpulse = Eigen::Vector4d;

/// What entered or left since the start of the run, besides the work of nodal conditions and of contact.
struct EnergyLedger {
  double external_work = 0.0;   ///< done by body forces, loads and tractions     [energy]
  double damping_work = 0.0;    ///< taken out by damping, >= 0                   [energy]
  double rigid_work = 0.0;      ///< done by rigid particles                      [energy]
  Vec3 impulse = Vec3::Zero();  ///< of all of these together                     [momentum]
};

inline void archive(Archive& a, EnergyLedger& ledger) {
  auto& [external_work, damping_work, rigid_work, impulse] = ledger;
  a.version(1);
  a("external_work", external_work), a("damping_work", damping_work);
  a("rigid_work", rigid_work), a("impulse", impulse);
}

}  // namespace tribo
