// SPDX-License-Identifier: MIT
#include "run/block_run.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "output/atomic_file.hpp"
#include "output/progress.hpp"
#include "output/provenance.hpp"
#include "run/block_results.hpp"
#include "run/clock.hpp"
#include "run/restart.hpp"
#include "run/signals.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tribo {
namespace {

struct Counters {
  std::int64_t archive = 0, history = 0, checkpoint = 0;
  double initial_energy = 0.0;
};

void save(Assembly& blocks, const Counters& at, const std::filesystem::path& path) {
  CheckpointWriter out;
  out.put("dimension", std::int64_t{blocks.plane() ? 2 : 3});
  out.put("counters", std::array<std::int64_t, 3>{at.archive, at.history, at.checkpoint});
  save_blocks(blocks, at.initial_energy, out);
  out.save(path);
}

Counters load(Assembly& blocks, const std::filesystem::path& path) {
  const Checkpoint in(path);
  if (in.integer("dimension") != (blocks.plane() ? 2 : 3))
    throw FileError("the checkpoint belongs to another command file: its blocks differ");
  const double energy = load_blocks(in, blocks);
  const auto counters = in.integers("counters");
  return {counters.at(0), counters.at(1), counters.at(2), energy};
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::map<std::string, std::string> facts(const Model& model, const Assembly& blocks) {
  std::map<std::string, std::string> out = unit_facts(model);
  out["title"] = model.title;
  out["blocks"] = std::to_string(blocks.block_count());
  out["contacts"] = std::to_string(blocks.contacts.size());
  return out;
}

}  // namespace

Assembly assemble(const Model& model) {
  return Assembly(model.blocks, model.dimension(), model.analysis == Analysis::plane_stress, model.body_force.gravity,
                  model.time.max_step);
}

BlockSteps steps_of(const Model& model, const Assembly& blocks) {
  BlockSteps out;
  out.count = static_cast<std::int64_t>(std::ceil(model.time.end / blocks.critical_step() * (1 - 1e-12)));
  out.size = model.time.end / static_cast<double>(std::max<std::int64_t>(1, out.count));
  return out;
}

int sensible_block_threads(int wanted, std::size_t contacts) {
  static constexpr std::size_t worthwhile = 2000;
  return std::max(1, std::min(wanted, static_cast<int>(1 + contacts / worthwhile)));
}

Outcome run_blocks(const Model& model, Assembly& blocks, const RunOptions& options) {
  set_threads(sensible_block_threads(options.threads, blocks.contacts.size()));
  SignalGuard signals;
  const auto begin = std::chrono::steady_clock::now();
  const auto checkpoint = options.folder / "checkpoint.bin";
  Counters at;
  std::optional<double> resume_time;
  if (options.resume) at = load(blocks, checkpoint), resume_time = blocks.time;
  if (!resume_time) write_atomically(options.folder / "model.path", source_of(model));

  const auto every = [&](double interval) {
    return interval > 0 ? Schedule::every(interval) : Schedule(model.output.archive);
  };
  Schedule archive(model.output.archive), history = every(model.output.history_interval),
                                          checkpoints = every(model.output.checkpoint_interval);
  archive.set_count(at.archive), history.set_count(at.history), checkpoints.set_count(at.checkpoint);
  BlockResults results(model, blocks, options.folder, resume_time);
  results.initial_energy = at.initial_energy;
  Provenance provenance(options.folder / "provenance.json", options.command_line, model.file, threads(),
                        facts(model, blocks));
  const BlockSteps steps = steps_of(model, blocks);
  const double begin_time = blocks.time;
  Stopwatch output;
  const auto report = [&](const std::string& status, const std::string& reason) {
    Provenance::Progress p;
    p.end_time = model.time.end, p.step = steps.size, p.seconds = seconds_since(begin);
    const double done = blocks.time - begin_time;
    p.seconds_left = done > 0 ? p.seconds * (model.time.end - blocks.time) / done : 0.0;
    p.seconds_of = {{"output", output.seconds()}, {"steps", p.seconds - output.seconds()}};
    provenance.set_progress(p);
    provenance.write(status, reason, blocks.time, static_cast<long>(blocks.step));
  };
  const auto save_now = [&] {
    save(blocks, {archive.count(), history.count(), checkpoints.count(), results.initial_energy}, checkpoint);
  };
  bool pictured = false;
  const auto write = [&](bool last) {
    const auto lap = output.lap();
    const double tolerance = 1e-6 * steps.size;
    if (history.due(blocks.time, tolerance) || last) results.write_history(steps.size);
    pictured = archive.due(blocks.time, tolerance);
    if (pictured) results.write_pictures(archive.count() - 1);
    if (checkpoints.due(blocks.time, tolerance)) save_now();
  };
  if (!resume_time) write(false);
  report("running", "");

  Progress progress(options.quiet, blocks.time, model.time.end, static_cast<std::int64_t>(blocks.block_count()),
                    "block");
  auto reported = begin;
  try {
    while (blocks.step < steps.count) {
      if (signals.stop() || (options.max_wall > 0 && seconds_since(begin) > options.max_wall)) {
        save_now();
        report("stopped", signals.stop() ? "signal" : "wall time");
        return Outcome::stopped;
      }
      if (signals.checkpoint()) signals.checkpoint_done(), save_now();
      blocks.advance(steps.size);
      results.write_events();
      write(blocks.step == steps.count);
      if (blocks.step % 64 == 0 || blocks.step == steps.count) {
        if (!blocks.sound())
          throw SimulationError("the motion of the blocks grew without bound at time " + std::to_string(blocks.time) +
                                "; damp it, or make the step smaller ('step' of <Blocks>)");
        blocks.check_contacts();
        if (seconds_since(reported) > 2) report("running", ""), reported = std::chrono::steady_clock::now();
      }
      progress.step(blocks.time, blocks.step, steps.size);
    }
  } catch (const SimulationError& error) {
    report("failed", error.what());
    throw;
  }
  if (!pictured && blocks.step > 0 && !(resume_time && *resume_time == blocks.time))
    results.write_pictures(archive.count());
  save_now();
  report("finished", "");
  progress.finish(blocks.time, blocks.step);
  return Outcome::finished;
}

}  // namespace tribo
