// SPDX-License-Identifier: MIT
#include "run/restart.hpp"

#include "blocks/assembly.hpp"

namespace tribo {
namespace {

// Everything is visited in this order, with the dimension first: it decides what the rest must be.
template <int Dim>
void visit(Archive& a, RunState& state, System<Dim>& system, Stepper<Dim>& stepper) {
  std::int64_t dimension = Dim;
  a("dimension", dimension);
  if (dimension != Dim) throw FileError("the checkpoint is of a model in " + std::to_string(dimension) + " dimensions");
  a("run", state);
  if (system.blocks) a("blocks", *system.blocks);
  a("stepper", stepper);
}

void check_counters(const RunState& state) {
  if (state.archive < 0 || state.history < 0 || state.checkpoint < 0 || state.dt < 0)
    refuse_checkpoint("the number of files or the time step is negative");
  if (state.stage < 0 || state.stage_step < 0 || state.stage_time < 0)
    refuse_checkpoint("the begin of its stage is negative");
}

// Numbers of a checkpoint that others are looked up with.
template <int Dim>
void check(const RunState& state, const System<Dim>& system, const Stepper<Dim>&) {
  check_counters(state);
  const auto bodies = static_cast<std::int64_t>(system.bodies.size());
  for (std::size_t k = 0; k < sign_count; ++k) {
    const Finding& f = state.monitor.findings[k];
    const bool of_particles = k == static_cast<std::size_t>(Sign::compressed) ||
                              k == static_cast<std::size_t>(Sign::expanded) ||
                              k == static_cast<std::size_t>(Sign::stretched);
    if (f.seen && (f.body >= bodies || (of_particles && f.body < 0)))
      refuse_checkpoint("a remark is on a body that does not exist");
  }
}

void check(const RunState& state, const Assembly&) { check_counters(state); }

void visit(Archive& a, RunState& state, Assembly& blocks) {
  const std::int64_t expected = blocks.plane() ? 2 : 3;
  std::int64_t dimension = expected;
  a("dimension", dimension);
  if (dimension != expected)
    throw FileError("the checkpoint is of a model in " + std::to_string(dimension) + " dimensions");
  a("run", state), a("blocks", blocks);
}

template <class... Parts>
void save(CheckpointWriter& to, RunState& state, Parts&... parts) {
  SavingArchive a(to);
  visit(a, state, parts...);
}

template <class... Parts>
RunState load(const Checkpoint& checkpoint, Parts&... parts) {
  RunState state;
  RestoringArchive a(checkpoint);
  visit(a, state, parts...);
  a.finish();
  check(state, parts...);
  return state;
}

}  // namespace

template <int Dim>
void save_state(RunState state, System<Dim>& system, Stepper<Dim>& stepper, CheckpointWriter& to) {
  save(to, state, system, stepper);
}

template <int Dim>
RunState load_state(const Checkpoint& checkpoint, System<Dim>& system, Stepper<Dim>& stepper) {
  return load(checkpoint, system, stepper);
}

void save_state(RunState state, Assembly& blocks, CheckpointWriter& to) { save(to, state, blocks); }

RunState load_state(const Checkpoint& checkpoint, Assembly& blocks) { return load(checkpoint, blocks); }

template void save_state<2>(RunState, System<2>&, Stepper<2>&, CheckpointWriter&);
template void save_state<3>(RunState, System<3>&, Stepper<3>&, CheckpointWriter&);
template RunState load_state<2>(const Checkpoint&, System<2>&, Stepper<2>&);
template RunState load_state<3>(const Checkpoint&, System<3>&, Stepper<3>&);

}  // namespace tribo
