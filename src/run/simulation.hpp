// SPDX-License-Identifier: MIT
/// A run from the model to the last file.
#pragma once

#include "model/model.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace tribo {

struct RunOptions {
  std::filesystem::path folder;  ///< of the results
  int threads = 1;
  bool quiet = false;
  bool overwrite = false;    ///< an existing finished run may be replaced
  bool resume = false;       ///< continue from the folder's checkpoint
  double max_wall = 0.0;     ///< seconds after which the run stops with a checkpoint; 0: none
  std::string command_line;  ///< for provenance.json
};

enum class Outcome {
  finished,
  stopped  ///< at a limit or by a signal; a checkpoint was written
};

/// The units of the results of a model, for provenance.json.
std::map<std::string, std::string> unit_facts(const Model& model);

/// Throws FileError if the folder holds results and the options do not allow to replace them.
void check_folder(const RunOptions& options);

/// Runs the model and writes its results into the folder: run.pvd, particles/, history.csv, energy.csv,
/// provenance.json, checkpoint.bin. SIGINT and SIGTERM finish the step, write a checkpoint and stop. Throws InputError,
/// SimulationError (after saving the last checkpoint), FileError.
Outcome run(const Model& model, const RunOptions& options);

/// Distance of the particle that moved farthest from its start.
struct Settlement {
  double late = 0.0;    ///< after three quarters of the run [length]
  double at_end = 0.0;  ///< [length]
  std::string failure;  ///< the reason if the run ended early
};
/// Runs the model and writes nothing.
Settlement settle(const Model& model, int threads);

/// Stops all runs after their present step, with a checkpoint; safe in a signal handler.
void request_stop();

}  // namespace tribo
