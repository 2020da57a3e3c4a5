// SPDX-License-Identifier: MIT
/// The state of a model before its run, in files.
#pragma once

#include "model/model.hpp"

#include <filesystem>
#include <string>

namespace tribo {

/// Builds the model and writes what `tribo view` shows into a folder with the parts of TrialFolder: particles and
/// blocks at the start, the record with the status `model`, and layers.json. Throws the exceptions that a run would
/// throw before its first step.
void write_model_view(const Model& model, const std::filesystem::path& folder, const std::string& command_line,
                      int threads);

}  // namespace tribo
