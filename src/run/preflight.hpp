// SPDX-License-Identifier: MIT
/// What a run would be, before it runs.
#pragma once

#include "model/model.hpp"

#include <string>

namespace tribo {

/// The pre-flight sheet: particles and volumes, gaps and thin bodies, contact, the time step and what controls it,
/// steps, memory, estimated time, and what to change. Runs a few steps for the estimate but writes nothing. Throws what
/// a run would throw before its first step.
std::string preflight(const Model& model, int threads);

}  // namespace tribo
