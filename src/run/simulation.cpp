// SPDX-License-Identifier: MIT
#include "run/simulation.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/ranks.hpp"
#include "base/text.hpp"
#include "run/block_run.hpp"
#include "run/distributed_run.hpp"
#include "run/grid_run.hpp"
#include "run/result_folder.hpp"
#include "run/run_loop.hpp"
#include "run/signals.hpp"
#include "run/staged_run.hpp"

#include <cstdio>
#include <memory>
#include <type_traits>

namespace tribo {
namespace {

// Where the size of a model is given.
const Origin& place_of(const Model& model) { return model.only_blocks() ? model.blocks->origin : model.grid.origin; }

// The kind of model in each stage of a run.
template <class Stepped>
struct Plain {
  using Type = Stepped;
};
template <class Stepped>
struct Plain<StagedRun<Stepped>> {
  using Type = Stepped;
};

// A run that has been opened: its model, its folder, and the guard that hears signals from then on.
template <class Stepped>
struct Opened {
  std::optional<Stepped> stepped;
  std::optional<SignalGuard> signals;
  std::optional<ResultFolder> folder;
};

// The model is built before the folder is touched, so that a wrong command file leaves old results as they are. Signals
// end the program until the run is able to continue from where they stop it.
template <class Stepped>
void start(Opened<Stepped>& run, const Model& model, const RunOptions& options) {
  if (!options.opened) check_folder(options);
  with_memory_for("this model", place_of(model), [&] {
    run.stepped.emplace(model);
    run.stepped->choose_threads(options.threads);
    run.stepped->start();
  });
  run.signals.emplace();
  if (!options.opened) run.folder.emplace(options.folder);
  ResultNames names = names_of_every_run();
  names.add(run.stepped->result_names()), names.add({options.further_files, {}});
  (options.opened ? *options.opened : *run.folder).start(names, options.overwrite);
}

// Turns the checkpoint of the former model into one of the present model, as at the begin of a stage.
template <class Stepped>
void begin_with_edits(const Model& former, const Model& model, const std::filesystem::path& file) {
  const Checkpoint old(file);
  const auto stage = static_cast<std::size_t>(std::max<std::int64_t>(0, old.integer("run.stage")));
  const auto of_stage = [&](const Model& m) -> const Model& {
    if (stage > m.stages.size())
      throw FileError("the run is in stage " + std::to_string(stage) + ", which the command file no longer has");
    return stage == 0 ? m : *m.stages[stage - 1].model;
  };
  const Model &before = of_stage(former), &now = of_stage(model);
  auto run = std::make_unique<Stepped>(before);
  const RunState state = run->restore(old);
  const StageBalance balance = run->end_stage();
  const Checkpoint end(run->save(state));
  run.reset();
  run = std::make_unique<Stepped>(now);
  run->restore(end);
  run->forget_placed();
  run->begin_stage(before, {}, balance);
  run->save(state).save(file);
}

// Opens the folder of a run that is to be continued.
template <class Stepped>
void reopen(std::optional<ResultFolder>& folder, const Model& model, const RunOptions& options) {
  if (!std::filesystem::is_directory(options.folder))
    throw FileError("there is no folder '" + options.folder.string() + "'");
  folder.emplace(options.folder).require_checkpoint();
  if (options.former)
    begin_with_edits<typename Plain<Stepped>::Type>(*options.former, model, folder->path() / "checkpoint.bin");
}

template <class Stepped>
void resume(Opened<Stepped>& run, const Model& model, const RunOptions& options) {
  reopen<Stepped>(run.folder, model, options);
  with_memory_for("this model", place_of(model), [&] { run.stepped.emplace(model); });
  run.stepped->choose_threads(options.threads);
}

template <class Stepped>
void open(Opened<Stepped>& run, const Model& model, const RunOptions& options) {
  options.resume ? resume(run, model, options) : start(run, model, options);
}

// A run whose caller takes the steps.
template <class Stepped>
class OpenRun final : public StepwiseRun {
 public:
  OpenRun(Model model, RunOptions options) : model_(std::move(model)), options_(std::move(options)) {
    open(run_, model_, options_);
    loop_.emplace(model_, *run_.stepped, options_);
    loop_->begin();
    run_.signals.reset();
  }

  Pause advance(std::int64_t steps) override {
    const SignalGuard signals;
    run_.stepped->choose_threads(options_.threads);
    try {
      return advance_by(steps);
    } catch (...) {
      release();
      throw;
    }
  }
  void stop(const std::string& reason) override {
    loop_->stop(reason);
    release();
  }
  void flush() override {
    if (run_.folder) loop_->flush();
  }
  const Model& model() const override { return model_; }
  SteppedModel& stepped() override { return *run_.stepped; }

 private:
  Pause advance_by(std::int64_t steps) {
    const std::int64_t before = loop_->files();
    for (std::int64_t k = 0; steps == 0 || k < steps; ++k) {
      if (loop_->at_end()) return end();
      if (loop_->wants_stop()) return SignalGuard::stop() ? Pause::signal : Pause::wall_time;
      loop_->step();
      if (steps == 0 && loop_->files() > before) return loop_->at_end() ? end() : Pause::due;
    }
    return loop_->at_end() ? end() : Pause::due;
  }
  Pause end() {
    loop_->finish();
    release();
    return Pause::end;
  }
  // The folder, in which everything has been written.
  void release() { run_.folder.reset(); }

  Model model_;
  RunOptions options_;
  Opened<Stepped> run_;
  std::optional<RunLoop> loop_;
};

// Calls f.operator()<Stepped>() for the kind of run that a model needs.
template <class F>
auto with_kind_of(const Model& model, F&& f) {
  const bool staged = !model.stages.empty() || !model.reactions.empty();
  if (model.only_blocks())
    return staged ? f.template operator()<StagedRun<BlockRun>>() : f.template operator()<BlockRun>();
  if (model.dimension() == 2)
    return staged ? f.template operator()<StagedRun<GridRun<2>>>() : f.template operator()<GridRun<2>>();
  return staged ? f.template operator()<StagedRun<GridRun<3>>>() : f.template operator()<GridRun<3>>();
}

template <class Stepped>
constexpr bool is_on_grid = !std::is_same_v<typename Plain<Stepped>::Type, BlockRun>;

// A run in a single process.
template <class Stepped>
Outcome run_alone(const Model& model, const RunOptions& options) {
  Opened<Stepped> opened;
  open(opened, model, options);
  return run_to_end(model, *opened.stepped, options);
}

// A run in several processes, of which rank 0 has the loop and the folder. An assembly of blocks without a grid is
// computed by rank 0 alone.
template <class Stepped>
Outcome run_in_processes(const Model& model, const RunOptions& options) {
  if (const auto missing = not_distributed(model); !missing.empty())
    throw InputError(place_of(model),
                     "this model runs in a single process only, because it has " + join(missing, ", "));
  if constexpr (is_on_grid<Stepped>) {
    if (ranks().rank() > 0) {
      const SignalGuard signals;  // only rank 0 acts on them
      follow<Stepped>(model, options.threads, options.folder / "checkpoint.bin");
      return Outcome::finished;
    }
    const EndForOthers end;
    Opened<LeadingRun<Stepped>> opened;
    if (options.resume) {
      {
        const AloneScope alone;
        reopen<Stepped>(opened.folder, model, options);
      }
      with_memory_for("this model", place_of(model), [&] { opened.stepped.emplace(model); });
    } else {
      start(opened, model, options);
    }
    opened.stepped->choose_threads(options.threads);
    return run_to_end(model, *opened.stepped, options);
  } else {
    if (ranks().rank() > 0) return Outcome::finished;
    if (!options.quiet)
      std::fprintf(stderr, "note: blocks without a grid are computed by the first of the processes alone\n");
    const AloneScope alone;
    return run_alone<Stepped>(model, options);
  }
}

template <int Dim>
Settlement settle(const Model& model, int thread_count) {
  GridRun<Dim> run(model);
  run.choose_threads(thread_count);
  Settlement out;
  run.start();
  const auto advance_to = [&](double time) {
    while (!run.has_reached(time)) heed_stop(), run.advance();
  };
  try {
    advance_to(0.75 * model.time.end);
    out.late = run.largest_displacement();
    advance_to(model.time.end);
    out.at_end = run.largest_displacement();
  } catch (const SimulationError& error) {
    out.failure = error.what();
  }
  return out;
}

}  // namespace

std::map<std::string, std::string> unit_facts(const Model& model) {
  std::map<std::string, std::string> out;
  using D = Dimension;
  for (const auto& [name, dimension] :
       {std::pair("length", D::length), std::pair("time", D::time), std::pair("velocity", D::velocity),
        std::pair("stress", D::stress), std::pair("force", D::force), std::pair("mass", D::mass)})
    out["unit of " + std::string(name)] = model.units.name(dimension);
  out["units"] = model.units.name(D::length) + ", " + model.units.name(D::mass) + ", " + model.units.name(D::time);
  return out;
}

void check_folder(const RunOptions& options) {
  if (!options.overwrite) refuse_used_folder(options.folder);
}

Outcome run(const Model& model, const RunOptions& options) {
  set_threads(options.threads);
  return with_kind_of(model, [&]<class Stepped>() {
    return ranks().count() > 1 ? run_in_processes<Stepped>(model, options) : run_alone<Stepped>(model, options);
  });
}

std::unique_ptr<StepwiseRun> open_run(Model model, RunOptions options) {
  set_threads(options.threads);
  const Model& given = model;
  return with_kind_of(given, [&]<class Stepped>() -> std::unique_ptr<StepwiseRun> {
    return std::make_unique<OpenRun<Stepped>>(std::move(model), std::move(options));
  });
}

Settlement settle(const Model& model, int thread_count) {
  return with_memory_for("this model", place_of(model), [&] {
    return model.dimension() == 2 ? settle<2>(model, thread_count) : settle<3>(model, thread_count);
  });
}

}  // namespace tribo
