// SPDX-License-Identifier: MIT
#include "run/simulation.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/result_folder.hpp"
#include "run/signals.hpp"
#include "run/staged_run.hpp"

#include <memory>

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

// The model is built before the folder is touched, so that a wrong command file leaves old results as they are. Signals
// end the program until the run is able to continue from where they stop it.
template <class Stepped>
Outcome start(const Model& model, const RunOptions& options) {
  if (!options.opened) check_folder(options);
  std::optional<Stepped> built;
  with_memory_for("this model", place_of(model), [&] {
    built.emplace(model);
    built->choose_threads(options.threads);
    built->start();
  });
  Stepped& stepped = *built;
  const SignalGuard signals;
  std::optional<ResultFolder> own;
  if (!options.opened) own.emplace(options.folder);
  ResultNames names = names_of_every_run();
  names.add(stepped.result_names()), names.add({options.further_files, {}});
  (options.opened ? *options.opened : *own).start(names, options.overwrite);
  return run_to_end(model, stepped, options);
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

template <class Stepped>
Outcome resume(const Model& model, const RunOptions& options) {
  if (!std::filesystem::is_directory(options.folder))
    throw FileError("there is no folder '" + options.folder.string() + "'");
  ResultFolder folder(options.folder);
  folder.require_checkpoint();
  if (options.former)
    begin_with_edits<typename Plain<Stepped>::Type>(*options.former, model, folder.path() / "checkpoint.bin");
  std::optional<Stepped> built;
  with_memory_for("this model", place_of(model), [&] { built.emplace(model); });
  Stepped& stepped = *built;
  stepped.choose_threads(options.threads);
  return run_to_end(model, stepped, options);
}

template <class Stepped>
Outcome start_or_resume(const Model& model, const RunOptions& options) {
  if (!model.stages.empty() || !model.reactions.empty())
    return options.resume ? resume<StagedRun<Stepped>>(model, options) : start<StagedRun<Stepped>>(model, options);
  return options.resume ? resume<Stepped>(model, options) : start<Stepped>(model, options);
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
  if (model.only_blocks()) return start_or_resume<BlockRun>(model, options);
  return model.dimension() == 2 ? start_or_resume<GridRun<2>>(model, options)
                                : start_or_resume<GridRun<3>>(model, options);
}

Settlement settle(const Model& model, int thread_count) {
  return with_memory_for("this model", place_of(model), [&] {
    return model.dimension() == 2 ? settle<2>(model, thread_count) : settle<3>(model, thread_count);
  });
}

}  // namespace tribo
