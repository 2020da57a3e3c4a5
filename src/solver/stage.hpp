// SPDX-License-Identifier: MIT
/// The begin of a stage: what it does to the state of a run in a grid.
#pragma once

#include "solver/step.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tribo {

/// What a stage has done when it began.
struct StageReport {
  std::int64_t excavated = 0;  ///< particles that were removed
  std::int64_t placed = 0;     ///< particles that were added
  std::int64_t covered = 0;    ///< particles that were not added, because there is matter at their places
  std::int64_t stressed = 0;   ///< particles whose stress was set
  std::int64_t bonded = 0;     ///< contacts that were bonded
  std::int64_t unbonded = 0;   ///< contacts whose bonds were broken
  double energy = 0.0;         ///< that the stage brought [energy]
  std::vector<std::string> warnings;
};

/// The joint law that ruled the same joints in the model before a stage; null if there is none.
const JointLaw* former_law(const Model& model, const Model& former, const JointLaw* law);

/// Carries out the actions of the stage of `model` on a system of this model that was restored from a checkpoint of
/// `former`, the model before: stiffnesses of joints, bonds, excavation, stress, placement, and the particles with
/// loads. The particles must be sorted afterwards, which the next step does.
template <int Dim>
StageReport begin_stage(const Model& model, const Model& former, const std::vector<StageAction>& actions,
                        System<Dim>& system, Stepper<Dim>& stepper);

/// The same for the contacts of rigid blocks.
void begin_stage(const Model& model, const Model& former, const std::vector<StageAction>& actions, Assembly& blocks,
                 StageReport& report);

}  // namespace tribo
