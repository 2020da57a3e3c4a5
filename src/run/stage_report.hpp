// SPDX-License-Identifier: MIT
/// The part of the pre-flight report on the stages of a run.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"

#include <string>
#include <vector>

namespace tribo {

/// `stage 1 'name'`
std::string title_of(const StageSpec& stage, int number);
/// A line for each stage: its time, and what changes. `seeds`: the particles at the start, of which an excavation would
/// remove so many if they had not moved.
std::vector<std::string> describe_stages(const Model& model, const Seeds& seeds);

}  // namespace tribo
