// SPDX-License-Identifier: MIT
/// The loop of every run: steps, output times, checkpoints, signals and the record of the run.
#pragma once

#include "output/checkpoint.hpp"
#include "output/output_queue.hpp"
#include "output/provenance.hpp"
#include "run/monitor_state.hpp"
#include "run/restart.hpp"
#include "run/result_folder.hpp"
#include "run/simulation.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// A model that advances in time: particles on a grid, or rigid blocks alone.
class SteppedModel {
 public:
  SteppedModel() = default;
  virtual ~SteppedModel() = default;
  SteppedModel(const SteppedModel&) = delete;
  SteppedModel& operator=(const SteppedModel&) = delete;

  virtual double time() const = 0;        ///< [time]
  virtual std::int64_t step() const = 0;  ///< number of steps done
  virtual double step_size() const = 0;   ///< of the present step [time]
  virtual bool at_end() const = 0;
  /// Whether the time has come at which the stage of the model ends, and the next one begins with the next step.
  virtual bool at_stage_end() const { return false; }

  /// Chooses the number of threads, at most `wanted`. Results do not depend on it.
  virtual void choose_threads(int wanted) const = 0;
  /// Chooses the first step of a run that starts at time 0, before its results are opened. Throws SimulationError if
  /// there is none.
  virtual void start() = 0;
  /// Takes one step; returns its size [time]. Throws SimulationError.
  virtual double advance() = 0;
  /// Called after each step, before its output: warnings of signs that the results are wrong, each of them once.
  virtual std::vector<std::string> look() { return {}; }
  /// What has happened since the last call and is worth a line of the log each: the begin of a stage.
  virtual std::vector<std::string> take_news() { return {}; }
  /// Whether a checkpoint has been asked for since the last call.
  virtual bool take_checkpoint() { return false; }
  /// Why the run ends before its time; empty if it does not.
  virtual std::string end_reason() const { return {}; }
  /// What the program has chosen for this model, a sentence each.
  virtual std::vector<std::string> choices() const { return {}; }
  /// What has been noticed so far, a line each.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Figures of the whole run, of the balance of energy above all, that are told at the end.
  virtual std::vector<Figure> figures() const { return {}; }
  /// Called after the output of a step. Throws SimulationError if the state has lost its meaning.
  virtual void check() {}

  /// The complete state; `run` holds the counters of the loop. Without open results the energies at the start are zero.
  virtual void save(RunState run, CheckpointWriter& to) = 0;
  CheckpointWriter save(const RunState& run) {
    CheckpointWriter out;
    save(run, out);
    return out;
  }
  /// Memory of the particles, by far the largest part of the state of a large model.
  virtual std::size_t particle_bytes() const { return 0; }
  /// Restores a freshly built model. Throws FileError if the checkpoint is of another model.
  virtual RunState restore(const Checkpoint& checkpoint) = 0;

  /// What the model writes of its own: without checkpoint and record.
  virtual ResultNames result_names() const = 0;
  /// Starts the files of results, or continues them after `resume_time`. Afterwards they are written by jobs of the
  /// queue, which must outlive their last output. Throws FileError.
  virtual void open_results(const std::filesystem::path& folder, std::optional<double> resume_time,
                            OutputQueue& queue) = 0;
  /// One row of the histories and of the energies.
  virtual void write_history() = 0;
  /// Files of the state under a number.
  virtual void write_files(std::int64_t number) = 0;
  /// The events since the last call.
  virtual void write_events() = 0;
  /// True if the histories always have a row of the last step; false if they have it when an output time, of histories
  /// or files, requires it.
  virtual bool history_of_last_step() const = 0;

  /// What moves, for the display of progress: how many, and their name in the singular.
  virtual std::pair<std::int64_t, std::string> moving() const = 0;
  /// The bodies of particles, if there are more of them than materials and not too many to be told apart.
  virtual std::vector<RecordedBody> bodies() const { return {}; }
  /// Further entries of the record of the run.
  virtual std::map<std::string, std::string> facts() const = 0;
  /// Seconds spent by part of the step; `steps` is the time spent outside of output.
  virtual std::map<std::string, double> seconds_of(double steps) const = 0;
};

/// What every run writes.
ResultNames names_of_every_run();

/// The loop of a run whose caller takes the steps. All calls may throw SimulationError and FileError; the run has then
/// failed, and its record says so. Signals are heard while the caller has a SignalGuard.
class RunLoop {
 public:
  /// Opens the results of a model that has started, or continues one from the checkpoint of the folder. All arguments
  /// must outlive the loop.
  RunLoop(const Model& model, SteppedModel& stepped, const RunOptions& options);
  ~RunLoop();
  RunLoop(const RunLoop&) = delete;
  RunLoop& operator=(const RunLoop&) = delete;

  /// The output before the first step; to be called once.
  void begin();
  bool at_end() const;
  /// Whether a signal or a limit, of the wall time or of the steps, asks to stop.
  bool wants_stop() const;
  /// What it is, for the record; empty if nothing asks.
  std::string reason_to_stop() const;
  /// One step with its output.
  void step();
  /// Files of the state that have been written so far, or are in the queue.
  std::int64_t files() const;
  /// Waits until everything given to the queue is in the files.
  void flush();
  /// The output at the end of a run.
  void finish();
  /// Ends the run here with a checkpoint; `reason` is for the record.
  void stop(const std::string& reason);

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

/// Runs a model that has started, or continues one from the checkpoint of the folder, to its end. Throws
/// SimulationError (the last checkpoint remains), FileError.
Outcome run_to_end(const Model& model, SteppedModel& stepped, const RunOptions& options);

}  // namespace tribo
