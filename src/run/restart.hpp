// SPDX-License-Identifier: MIT
/// The state of a run as a checkpoint, complete to the bit.
#pragma once

#include "output/checkpoint_archive.hpp"
#include "run/monitor_state.hpp"
#include "solver/step.hpp"

namespace tribo {

/// State of the run that belongs to its output rather than to the model.
struct RunState {
  std::int64_t archive = 0, history = 0, checkpoint = 0;  ///< output times already written
  double initial_energy = 0.0;                            ///< content of energy at the start              [energy]
  double initial_block_energy = 0.0;                      ///< the same of blocks                          [energy]
  double dt = 0.0;                                        ///< present step                                [time]
  MonitorState monitor;                                   ///< what the run has noticed so far
  std::int64_t stage = 0;                                 ///< of the model; 0: the model at the start
  bool stage_ends = false;                                ///< the next stage begins before its time
  std::int64_t stage_step = 0;                            ///< number of steps when the stage began
  double stage_time = 0.0;                                ///< when the stage began                        [time]
  std::int64_t reacted = 0;                               ///< bit k set: reaction k of the stage has happened
  std::int64_t calm = 0;                                  ///< number of steps in a row with balanced forces
  std::int64_t frames = 0;                                ///< files written by reactions
  double block_stages = 0.0;                              ///< energy that stages brought to blocks        [energy]
};

inline void archive(Archive& a, RunState& state) {
  auto& [particle_files, histories, checkpoints, initial_energy, initial_block_energy, dt, monitor, stage, ends, step,
         time, reacted, calm, frames, block_stages] = state;
  a.version(3);
  a("archive", particle_files), a("history", histories), a("checkpoint", checkpoints);
  a("initial_energy", initial_energy), a("initial_block_energy", initial_block_energy), a("dt", dt);
  a("monitor", monitor);
  a("stage", stage), a("stage_ends", ends), a("stage_step", step), a("stage_time", time);
  a("reacted", reacted), a("calm", calm), a("frames", frames), a("block_stages", block_stages);
}

/// A run in a grid, with the blocks in it.
template <int Dim>
void save_state(RunState state, System<Dim>& system, Stepper<Dim>& stepper, CheckpointWriter& to);
/// Fills a freshly built system. Throws FileError if the checkpoint is of another model.
template <int Dim>
RunState load_state(const Checkpoint& checkpoint, System<Dim>& system, Stepper<Dim>& stepper);

/// A run of blocks without a grid.
void save_state(RunState state, Assembly& blocks, CheckpointWriter& to);
/// Fills a freshly built assembly. Throws FileError if the checkpoint is of another model.
RunState load_state(const Checkpoint& checkpoint, Assembly& blocks);

}  // namespace tribo
