// SPDX-License-Identifier: MIT
/// The report of a model before it runs.
#pragma once

#include "model/model.hpp"

#include <string>

namespace tribo {

/// The report: particles and volumes, gaps and thin bodies, contact, the time step and what controls it,
/// steps, memory, estimated time, and advice. Runs a few steps for the estimate but writes nothing. Throws the
/// exceptions that a run would throw before its first step.
std::string preflight(const Model& model, int threads);

}  // namespace tribo
