// SPDX-License-Identifier: MIT
#include "run/simulation.hpp"

#include "base/parallel.hpp"
#include "output/atomic_file.hpp"
#include "output/progress.hpp"
#include "output/provenance.hpp"
#include "run/block_run.hpp"
#include "run/clock.hpp"
#include "run/restart.hpp"
#include "run/results.hpp"
#include "run/signals.hpp"
#include "run/step_size.hpp"
#include "solver/build.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tribo {
namespace {

template <int Dim>
class Simulation {
 public:
  Simulation(const Model& model, const RunOptions& options)
      : model_(model),
        options_(options),
        system_(build_system<Dim>(model, place_points(model))),
        stepper_(model, system_),
        archive_(model.output.archive),
        history_(model.output.history_interval > 0 ? Schedule::every(model.output.history_interval)
                                                   : Schedule(model.output.archive)),
        checkpoints_(model.output.checkpoint_interval > 0 ? Schedule::every(model.output.checkpoint_interval)
                                                          : Schedule(model.output.archive)),
        step_size_(model, system_) {}

  Outcome run() {
    set_threads(sensible_threads(options_.threads, particle_count(system_)));
    SignalGuard signals;
    const auto begin = std::chrono::steady_clock::now();
    const auto checkpoint = options_.folder / "checkpoint.bin";
    std::optional<double> resume_time;
    RunState state;
    if (options_.resume) {
      const Checkpoint saved(checkpoint);
      state = load_state(saved, system_, stepper_);
      resume_time = system_.time;
      archive_.set_count(state.archive), history_.set_count(state.history), checkpoints_.set_count(state.checkpoint);
    }
    // Where the model came from, for 'tribo resume'
    if (!resume_time) write_atomically(options_.folder / "model.path", source_of(model_));
    Results<Dim> results(model_, system_, stepper_, options_.folder, resume_time);
    results.initial_energy = state.initial_energy;
    if (results.blocks) results.blocks->initial_energy = state.initial_block_energy;
    Provenance provenance(options_.folder / "provenance.json", options_.command_line, model_.file, threads(), facts());
    dt_ = resume_time ? state.dt : step_size_.first().size;
    const double begin_time = system_.time;
    const auto report = [&](const std::string& status, const std::string& reason) {
      provenance.set_progress(progress_since(begin_time, seconds_since(begin)));
      provenance.write(status, reason, system_.time, static_cast<long>(system_.step));
    };
    report("running", "");
    auto reported = begin;

    const auto save = [&] {
      save_state({archive_.count(), history_.count(), checkpoints_.count(), results.initial_energy, dt_,
                  results.blocks ? results.blocks->initial_energy : 0.0},
                 system_, stepper_)
          .save(checkpoint);
      stepper_.contact().clear_cache();
    };
    const auto write = [&](bool all) {
      const auto lap = output_watch_.lap();
      const double tolerance = 1e-6 * dt_;
      if (history_.due(system_.time, tolerance) || all) results.write_history(dt_);
      if (archive_.due(system_.time, tolerance) || all) results.write_particles(archive_.count() - (all ? 0 : 1));
      if (checkpoints_.due(system_.time, tolerance) || all) save();
    };
    if (!resume_time) write(false);

    Progress progress(options_.quiet, system_.time, model_.time.end, particle_count(system_), "particle");
    const std::int64_t first_step = system_.step;
    try {
      while (system_.time < model_.time.end * (1 - 1e-12)) {
        // A few steps more, if contact keeps something that a checkpoint does not hold
        const bool stop = signals.stop() || (options_.max_wall > 0 && seconds_since(begin) > options_.max_wall);
        if (stop && stepper_.contact().interruptible()) {
          save();
          report("stopped", signals.stop() ? "signal" : "wall time");
          return Outcome::stopped;
        }
        if (signals.checkpoint() && stepper_.contact().interruptible()) {
          signals.checkpoint_done();
          save();
        }
        dt_ = step_size_.next(dt_);
        const double step = step_size_.up_to_end(std::min(dt_, stepper_.joints().stable_step()));
        stepper_.damping().update(step, [&] { return measure(system_).kinetic; });
        stepper_.advance(step);
        results.write_events();
        write(false);
        if (system_.step % 16 == 0 && seconds_since(reported) > between_reports) {
          report("running", "");
          reported = std::chrono::steady_clock::now();
        }
        progress.step(system_.time, system_.step, step);
      }
    } catch (const SimulationError& error) {
      report("failed", error.what());
      const bool usable = std::filesystem::exists(checkpoint);
      throw SimulationError(std::string(error.what()) +
                            (usable ? "\nThe last checkpoint is in '" + checkpoint.string() + "'." : std::string()));
    }
    if (system_.step > first_step) finish(results);
    save();
    report("finished", "");
    progress.finish(system_.time, system_.step);
    return Outcome::finished;
  }

  Settlement settle() {
    set_threads(sensible_threads(options_.threads, particle_count(system_)));
    Settlement out;
    dt_ = step_size_.first().size;
    const auto until = [&](double time) {
      while (system_.time < time * (1 - 1e-12)) {
        dt_ = step_size_.next(dt_);
        const double step = step_size_.up_to_end(std::min(dt_, stepper_.joints().stable_step()));
        stepper_.damping().update(step, [&] { return measure(system_).kinetic; });
        stepper_.advance(step);
      }
    };
    try {
      until(0.75 * model_.time.end);
      out.late = largest_displacement();
      until(model_.time.end);
      out.at_end = largest_displacement();
    } catch (const SimulationError& error) {
      out.failure = error.what();
    }
    return out;
  }

 private:
  static constexpr double between_reports = 2.0;  // seconds

  Provenance::Progress progress_since(double begin_time, double seconds) const {
    Provenance::Progress p;
    p.end_time = model_.time.end, p.step = dt_, p.seconds = seconds;
    const double done = system_.time - begin_time;
    p.seconds_left = done > 0 ? seconds * (model_.time.end - system_.time) / done : 0.0;
    const StepWatches& w = stepper_.watches();
    const double contact = stepper_.contact().watch.seconds();
    p.seconds_of = {{"sorting", w.sort.seconds()},
                    {"particles to nodes", w.scatter.seconds()},
                    {"nodes", w.grid.seconds()},
                    {"nodes to particles, stress", w.gather.seconds()},
                    {"contact", contact},
                    {"filter (XPIC, FMPM)", stepper_.filter().watch.seconds()},
                    {"output", output_watch_.seconds()}};
    double named = contact + stepper_.filter().watch.seconds();
    for (const Stopwatch* watch : {&w.sort, &w.scatter, &w.grid, &w.gather}) named += watch->seconds();
    p.seconds_of["loads, heat, rest of the step"] = std::max(0.0, w.all.seconds() - named);
    return p;
  }

  static double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  std::map<std::string, std::string> facts() const {
    std::map<std::string, std::string> out = unit_facts(model_);
    out["title"] = model_.title;
    for (const auto& body : system_.bodies) out["particles of " + body.name] = std::to_string(body.particles.size());
    if (system_.blocks) out["blocks"] = std::to_string(system_.blocks->block_count());
    return out;
  }

  double largest_displacement() {
    double most = 0.0;
    for (auto& body : system_.bodies) {
      const auto x = body.particles.x(), origin = body.particles[body.origin];
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        double square = 0.0;
        for (std::size_t d = 0; d < Dim; ++d) square += (x[d][i] - origin[d][i]) * (x[d][i] - origin[d][i]);
        most = std::max(most, square);
      }
    }
    return std::sqrt(most);
  }

  // The last state is always on disk, also if the end is no output time.
  void finish(Results<Dim>& results) {
    if (last_written(archive_)) return;
    results.write_history(dt_);
    results.write_particles(archive_.count());
  }
  bool last_written(const Schedule& schedule) const {
    Schedule before = schedule;
    before.set_count(schedule.count() - 1);
    return schedule.count() > 0 && before.due(system_.time, 1e-6 * dt_) &&
           !Schedule(before).due(system_.time - 0.5 * dt_, 0.0);
  }

  const Model& model_;
  const RunOptions& options_;
  System<Dim> system_;
  Stepper<Dim> stepper_;
  Schedule archive_, history_, checkpoints_;
  Stopwatch output_watch_;
  StepSize<Dim> step_size_;
  double dt_ = 0.0;
};

void prepare_folder(const RunOptions& options, const std::vector<const char*>& parts) {
  const auto& folder = options.folder;
  if (options.resume) {
    if (!std::filesystem::exists(folder / "checkpoint.bin"))
      throw FileError("'" + folder.string() + "' has no checkpoint.bin to resume from");
    return;
  }
  refuse_used_folder(options);
  std::error_code error;
  std::filesystem::remove_all(folder / "particles", error);
  std::filesystem::remove_all(folder / "grid", error);
  std::filesystem::remove_all(folder / "cracks", error);
  std::filesystem::remove_all(folder / "joints", error);
  std::filesystem::remove_all(folder / "blocks", error);
  std::filesystem::remove_all(folder / "contacts", error);
  for (const char* file :
       {"run.pvd", "grid.pvd", "cracks.pvd", "joints.pvd", "blocks.pvd", "contacts.pvd", "events.csv", "tips.csv",
        "block_events.csv", "block_energy.csv", "history.csv", "energy.csv", "checkpoint.bin", "provenance.json"})
    std::filesystem::remove(folder / file, error);
  for (const char* part : parts) {
    std::filesystem::create_directories(folder / part, error);
    if (error) throw FileError("cannot create '" + (folder / part).string() + "': " + error.message());
  }
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

void refuse_used_folder(const RunOptions& options) {
  const auto& folder = options.folder;
  const bool used = std::filesystem::exists(folder / "run.pvd") || std::filesystem::exists(folder / "blocks.pvd") ||
                    std::filesystem::exists(folder / "provenance.json");
  if (used && !options.overwrite)
    throw FileError("'" + folder.string() +
                    "' already holds a run; pass --overwrite to replace it, --output DIR for another folder, or use "
                    "'tribo resume'");
}

Outcome run(const Model& model, const RunOptions& options) {
  set_threads(options.threads);
  if (model.only_blocks()) {
    Assembly blocks = assemble(model);
    prepare_folder(options, {"blocks", "contacts"});
    return run_blocks(model, blocks, options);
  }
  std::vector<const char*> of_particles{"particles", "grid", "cracks", "joints"};
  if (model.blocks) of_particles.insert(of_particles.end(), {"blocks", "contacts"});
  if (model.dimension() == 2) {
    Simulation<2> simulation(model, options);
    prepare_folder(options, of_particles);
    return simulation.run();
  }
  Simulation<3> simulation(model, options);
  prepare_folder(options, of_particles);
  return simulation.run();
}

Settlement settle(const Model& model, int thread_count) {
  RunOptions options;
  options.threads = thread_count;
  return model.dimension() == 2 ? Simulation<2>(model, options).settle() : Simulation<3>(model, options).settle();
}

}  // namespace tribo
