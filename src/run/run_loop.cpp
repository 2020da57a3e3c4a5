// SPDX-License-Identifier: MIT
#include "run/run_loop.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "output/atomic_file.hpp"
#include "output/progress.hpp"
#include "output/provenance.hpp"
#include "run/model_record.hpp"
#include "run/run_record.hpp"
#include "run/schedule.hpp"
#include "run/signals.hpp"

#include <chrono>
#include <memory>

namespace tribo {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

Schedule every(double interval, const OutputSpec& output) {
  return interval > 0 ? Schedule::every(interval) : Schedule(output.archive);
}

// Copies of the state for output come and go; the pages of their memory are kept for the next ones, as it takes as long
// to get them from the system as to fill them.
void keep_pages_of_copies() { return_arrays_above(32 << 20, 256 << 20); }

}  // namespace

class RunLoop::Loop {
 public:
  Loop(const Model& model, SteppedModel& stepped, const RunOptions& options)
      : model_(model),
        stepped_(stepped),
        options_(options),
        checkpoint_(options.folder / "checkpoint.bin"),
        resume_time_(prepare()),
        begin_time_(stepped.time()),
        provenance_(options.folder / "provenance.json", options.command_line, model.file, threads(),
                    facts_of(model, stepped, options.changes)),
        progress_(options.quiet, stepped.time(), model.time.end, stepped.moving().first, stepped.moving().second) {
    progress_.wording = options.wording;
    ResultNames names = names_of_every_run();
    names.add(stepped.result_names());
    std::vector<std::filesystem::path> flushed;
    for (const std::string& name : names.files)
      if (name.ends_with(".csv")) flushed.push_back(options.folder / name);
    for (const std::string& name : names.frames) flushed.push_back(options.folder / name);
    flushed.push_back(options.folder);
    flushed_ = std::make_shared<const std::vector<std::filesystem::path>>(std::move(flushed));
    provenance_.set_legend(legend_of(model, stepped));
  }

  // Does a part of the run. A failure ends it: what was to be written is written, and the failure is recorded.
  template <class F>
  void guarded(F&& part) {
    try {
      part();
    } catch (const SimulationError& error) {
      finish_output();
      report_failure(error.what());
      const bool usable = std::filesystem::exists(checkpoint_);
      throw SimulationError(std::string(error.what()) +
                            (usable ? "\nThe last checkpoint is in '" + checkpoint_.string() + "'." : std::string()));
    } catch (const std::bad_alloc&) {
      finish_output();
      report_failure("not enough memory");
      throw FileError("not enough memory for step " + std::to_string(stepped_.step()) + " of this run" + remains());
    } catch (const FileError& error) {
      finish_output();
      report_failure(error.what());
      throw FileError(error.what() + remains());
    } catch (const std::exception& error) {
      finish_output();
      report_failure(error.what());
      throw;
    }
  }

  void begin() {
    report("running", "");
    for (const std::string& choice : stepped_.choices()) progress_.say(choice);
    if (!resume_time_) write_due(), save_due();
    first_step_ = stepped_.step();
  }

  bool at_end() const { return stepped_.at_end(); }

  bool wants_stop() const { return !reason_to_stop().empty(); }
  /// Empty if there is none.
  std::string reason_to_stop() const {
    if (SignalGuard::stop()) return "signal";
    if (options_.max_wall > 0 && seconds_since(begin_) > options_.max_wall) return "wall time";
    if (options_.max_steps > 0 && stepped_.step() - first_step_ >= options_.max_steps) return "number of steps";
    return {};
  }

  void step() {
    if (SignalGuard::checkpoint()) SignalGuard::checkpoint_done(), save();
    const double size = stepped_.advance();
    for (const std::string& warning : stepped_.look()) progress_.warn(warning);
    {
      const auto lap = output_.lap();
      stepped_.write_events();
    }
    write_due();
    stepped_.check();  // before the checkpoint, which then holds a state that was found sound, and what the check noted
    save_due();
    if (stepped_.take_checkpoint()) save();
    for (const std::string& news : stepped_.take_news()) progress_.say(news);
    if (stepped_.step() % steps_per_report == 0 && seconds_since(reported_) > between_reports) {
      report("running", "");
      reported_ = Clock::now();
    }
    progress_.step(stepped_.time(), stepped_.step(), size);
  }

  std::int64_t files() const { return written_; }
  void flush() { queue_.drain(); }

  void stop(const std::string& reason) {
    save(Until::on_disk);
    report("stopped", reason);
    tell_remarks();
  }

  void finish() {
    if (stepped_.step() > first_step_) write_last_state();
    save(Until::on_disk);
    report("finished", stepped_.end_reason());
    progress_.finish(stepped_.time(), stepped_.step());
    tell_remarks();
  }

 private:
  static constexpr double between_reports = 2.0;        // seconds
  static constexpr std::int64_t steps_per_report = 16;  // the clock is read only then

  // What a user can do after a failure that the model is not to blame for.
  std::string remains() const {
    const std::string folder = options_.folder.string();
    if (!std::filesystem::exists(checkpoint_))
      return std::string("\nThere is no checkpoint yet; to start again: ") +
             (options_.from_python ? "tribo.run with overwrite=True" : "tribo run --overwrite");
    return "\nThe last checkpoint remains; to continue from it: " +
           (options_.from_python ? "tribo.resume('" + folder + "')" : "tribo resume " + folder);
  }

  // What was to be written before a failure is written as far as it can be.
  void finish_output() {
    try {
      queue_.drain();
    } catch (const std::exception&) {
      return;
    }
  }

  // The failure itself is told in any case.
  void report_failure(const std::string& reason) {
    try {
      report("failed", reason);
    } catch (const FileError&) {
      return;
    }
  }

  // Builds or restores the state and opens the files. Returns the time from which the run continues, if it does.
  std::optional<double> prepare() {
    std::optional<double> resume_time;
    if (options_.resume) {
      const RunState state = stepped_.restore(Checkpoint(checkpoint_));
      resume_time = stepped_.time();
      files_.set_count(state.archive), histories_.set_count(state.history), checkpoints_.set_count(state.checkpoint);
    }
    if (!options_.resume || options_.changed) write_model_record(options_.folder, model_);
    stepped_.open_results(options_.folder, resume_time, queue_);
    return resume_time;
  }

  // What the run says about itself, after its end or when it stops.
  void tell_remarks() {
    if (const std::string reason = stepped_.end_reason(); !reason.empty())
      progress_.say("the run stopped before its end: " + reason);
    for (const Figure& figure : stepped_.figures()) progress_.say(figure.text);
    const auto remarks = stepped_.remarks();
    if (!remarks.empty()) progress_.say("to look at:");
    for (const std::string& remark : remarks) progress_.say("- " + remark);
  }

  void write_due() {
    const auto lap = output_.lap();
    const double time = stepped_.time(), tolerance = 1e-6 * stepped_.step_size();
    const bool last = stepped_.history_of_last_step() && stepped_.step() > 0 && stepped_.at_end();
    if (histories_.due(time, tolerance) || last) stepped_.write_history();
    if (files_.due(time, tolerance)) stepped_.write_files(files_.count() - 1), ++written_;
  }

  void save_due() {
    if (checkpoints_.due(stepped_.time(), 1e-6 * stepped_.step_size())) save();
  }

  // The last state is always on disk, also if the end is no output time.
  void write_last_state() {
    Schedule last = files_;
    last.set_count(files_.count() - 1);
    const auto is_due = [&](double time, double tolerance) { return Schedule(last).due(time, tolerance); };
    const double time = stepped_.time(), dt = stepped_.step_size();
    const bool written = files_.count() > 0 && is_due(time, 1e-6 * dt) && !is_due(time - 0.5 * dt, 0.0);
    if (written) return;
    const auto lap = output_.lap();
    if (!stepped_.history_of_last_step()) stepped_.write_history();
    stepped_.write_files(files_.count()), ++written_;
  }

  enum class Until { given, on_disk };

  // Everything that is older than a checkpoint reaches the disk before it, so that a run continues after a power cut.
  // The files themselves are flushed when they are written, but not the rows of tables and the names of files. The name
  // of the checkpoint is flushed with those of later files, or at the end: until then the former one may return.
  void save(Until until = Until::given) {
    const auto lap = output_.lap();
    queue_.begin(stepped_.step());
    RunState state;
    state.archive = files_.count(), state.history = histories_.count(), state.checkpoint = checkpoints_.count();
    if (stepped_.particle_bytes() > queue_.most_copied()) return save_now(state, until);
    const auto all = std::make_shared<const CheckpointWriter>(stepped_.save(state));
    queue_.add_checkpoint(all->size(), [all, until, folder = options_.folder, file = checkpoint_, flushed = flushed_] {
      for (const std::filesystem::path& path : *flushed) flush_to_disk(path);
      all->save(file);
      if (until == Until::on_disk) flush_to_disk(folder);
    });
    if (until == Until::on_disk) queue_.drain();
  }

  // Without a copy of the state. The run waits for the writing, but not for the disk.
  void save_now(const RunState& state, Until until) {
    queue_.drain();
    const auto complete = begin_checkpoint(checkpoint_, [&](CheckpointWriter& to) { stepped_.save(state, to); });
    queue_.add(0, [complete, until, folder = options_.folder, flushed = flushed_] {
      for (const std::filesystem::path& path : *flushed) flush_to_disk(path);
      complete();
      if (until == Until::on_disk) flush_to_disk(folder);
    });
    if (until == Until::on_disk) queue_.drain();
  }

  void report(const std::string& status, const std::string& reason) {
    Provenance::Progress p;
    p.end_time = model_.time.end, p.step = stepped_.step_size(), p.seconds = seconds_since(begin_);
    const double done = stepped_.time() - begin_time_;
    p.seconds_left = done > 0 ? p.seconds * (model_.time.end - stepped_.time()) / done : 0.0;
    p.seconds_of = stepped_.seconds_of(p.seconds - output_.seconds());
    p.seconds_of["output"] = output_.seconds();
    p.seconds_writing = queue_.seconds();
    provenance_.set_progress(p);
    note(status != "running");
    provenance_.write(status, reason, stepped_.time(), static_cast<long>(stepped_.step()));
  }

  // What the summary tells is in the record, too, whether the run is quiet or not. Figures are those of the end.
  void note(bool at_end) {
    std::vector<std::string> remarks = stepped_.remarks(), figures;
    if (at_end)
      for (Figure& figure : stepped_.figures())
        (figure.is_warning ? remarks : figures).push_back(std::move(figure.text));
    provenance_.set_remarks(std::move(remarks), std::move(figures));
  }

  const Model& model_;
  SteppedModel& stepped_;
  const RunOptions& options_;
  Clock::time_point begin_ = Clock::now(), reported_ = begin_;
  Stopwatch output_;  // what the run waits for
  OutputQueue queue_;
  Schedule files_{model_.output.archive};
  Schedule histories_ = every(model_.output.history_interval, model_.output);
  Schedule checkpoints_ = every(model_.output.checkpoint_interval, model_.output);
  std::filesystem::path checkpoint_;
  std::shared_ptr<const std::vector<std::filesystem::path>> flushed_;  // before a checkpoint
  std::optional<double> resume_time_;
  double begin_time_;
  std::int64_t first_step_ = 0, written_ = 0;
  Provenance provenance_;
  Progress progress_;
};

RunLoop::RunLoop(const Model& model, SteppedModel& stepped, const RunOptions& options) {
  keep_pages_of_copies();
  loop_ = std::make_unique<Loop>(model, stepped, options);
}
RunLoop::~RunLoop() = default;

void RunLoop::begin() {
  loop_->guarded([&] { loop_->begin(); });
}
bool RunLoop::at_end() const { return loop_->at_end(); }
bool RunLoop::wants_stop() const { return loop_->wants_stop(); }
std::string RunLoop::reason_to_stop() const { return loop_->reason_to_stop(); }
void RunLoop::step() {
  loop_->guarded([&] { loop_->step(); });
}
std::int64_t RunLoop::files() const { return loop_->files(); }
void RunLoop::flush() { loop_->flush(); }
void RunLoop::finish() {
  loop_->guarded([&] { loop_->finish(); });
}
void RunLoop::stop(const std::string& reason) {
  loop_->guarded([&] { loop_->stop(reason); });
}

ResultNames names_of_every_run() {
  return {{"provenance.json", "checkpoint.bin", "tribo-model.json", "tribo-model.xml", "history.csv", "energy.csv"},
          {}};
}

Outcome run_to_end(const Model& model, SteppedModel& stepped, const RunOptions& options) {
  const SignalGuard signals;
  RunLoop loop(model, stepped, options);
  loop.begin();
  while (!loop.at_end()) {
    if (loop.wants_stop()) {
      loop.stop(loop.reason_to_stop());
      return Outcome::stopped;
    }
    loop.step();
  }
  loop.finish();
  return Outcome::finished;
}

}  // namespace tribo
