// SPDX-License-Identifier: MIT
/// A run from the model to the last file.
#pragma once

#include "model/model.hpp"
#include "run/result_folder.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace tribo {

struct RunOptions {
  std::filesystem::path folder;  ///< of the results
  int threads = 1;
  bool quiet = false;
  bool overwrite = false;    ///< an existing finished run may be replaced
  bool resume = false;       ///< continue from the folder's checkpoint
  bool changed = false;      ///< resume: the model differs from that of the run, as `changes` says
  std::string changes = {};  ///< for provenance.json
  /// Resume with a changed model: the model of the run so far, if what has changed shall be a stage from now on.
  std::shared_ptr<const Model> former = nullptr;
  double max_wall = 0.0;       ///< seconds after which the run stops with a checkpoint; 0: none
  std::int64_t max_steps = 0;  ///< steps after which the run stops with a checkpoint; 0: none
  std::string command_line;    ///< for provenance.json
  bool from_python = false;    ///< advice names functions of the Python package, not commands
  /// Turns the keywords in messages into those of the command file; empty: they are elements of XML.
  std::function<std::string(const std::string&)> wording = {};
  std::vector<std::string> further_files = {};  ///< that the caller writes into the folder
  ResultFolder* opened = nullptr;               ///< the folder, if the caller has opened it
};

enum class Outcome {
  finished,
  stopped  ///< at a limit or by a signal; a checkpoint was written
};

/// The units of the results of a model, for provenance.json.
std::map<std::string, std::string> unit_facts(const Model& model);

/// Throws UsedFolderError if the folder holds results and the options do not allow to replace them.
void check_folder(const RunOptions& options);

/// Runs the model and writes its results into the folder: run.pvd, particles/, history.csv, energy.csv,
/// provenance.json, checkpoint.bin. SIGINT, SIGTERM and SIGHUP finish the step, write a checkpoint and stop. Throws
/// InputError, SimulationError (the last checkpoint remains), FileError.
Outcome run(const Model& model, const RunOptions& options);

class SteppedModel;

/// A run whose caller takes the steps: the same steps and files as by run(). Between the calls signals are not heard.
class StepwiseRun {
 public:
  StepwiseRun() = default;
  virtual ~StepwiseRun() = default;
  StepwiseRun(const StepwiseRun&) = delete;
  StepwiseRun& operator=(const StepwiseRun&) = delete;

  enum class Pause {
    due,       ///< files were written, or the steps are done
    end,       ///< the run has finished; no further call of advance() may follow
    signal,    ///< a signal asks to stop
    wall_time  ///< the limit of the wall time is reached
  };
  /// Takes so many steps; with 0, steps up to the next files. Throws SimulationError, FileError; the run is then over.
  virtual Pause advance(std::int64_t steps) = 0;
  /// Ends the run with a checkpoint; `reason` is for the record. No further call of advance() may follow.
  virtual void stop(const std::string& reason) = 0;
  /// Waits until all output so far is in the files. After the end of the run its folder is free for others.
  virtual void flush() = 0;
  virtual const Model& model() const = 0;
  virtual SteppedModel& stepped() = 0;
};

/// Starts or resumes a run, and writes the first output. Throws as run().
std::unique_ptr<StepwiseRun> open_run(Model model, RunOptions options);

/// Distance of the particle that moved farthest from its start.
struct Settlement {
  double late = 0.0;    ///< after three quarters of the run [length]
  double at_end = 0.0;  ///< [length]
  std::string failure;  ///< the reason if the run ended early
};
/// Runs the model and writes nothing. Throws StopRequest.
Settlement settle(const Model& model, int threads);

/// Stops all runs after their present step, with a checkpoint; safe in a signal handler.
void request_stop();

}  // namespace tribo
