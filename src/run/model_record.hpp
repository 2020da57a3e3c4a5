// SPDX-License-Identifier: MIT
/// The model of a run as kept in the folder of the run, for its resumption.
#pragma once

#include "model/model.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tribo {

/// What `tribo-model.json` and `tribo-model.xml` tell: where the model came from and what it was.
struct ModelRecord {
  std::filesystem::path file, relative;         ///< the command file: absolute, and from the folder of the run
  std::map<std::string, std::string> settings;  ///< variables that were set on the command line
  std::vector<std::string> lines;               ///< of the command file
  std::string meaning;                          ///< the statements of the model as XML
  std::map<std::string, std::string> data;      ///< files that the model reads, and their checksums
};

/// The copy of the model in the folder of a run, which is a command file of its own.
std::filesystem::path copy_of_model(const std::filesystem::path& folder);

void write_model_record(const std::filesystem::path& folder, const Model& model);
/// Throws FileError if the folder has no such record.
ModelRecord read_model_record(const std::filesystem::path& folder);

/// What differs between the model of a run and a model that shall continue it, a line each; empty if they mean the
/// same. Lines of the command file have their number and the sign - or +.
std::vector<std::string> changes(const ModelRecord& record, const Model& now);

}  // namespace tribo
