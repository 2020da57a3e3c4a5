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
};

inline void archive(Archive& a, RunState& state) {
  auto& [particle_files, histories, checkpoints, initial_energy, initial_block_energy, dt, monitor] = state;
  a.version(2);
  a("archive", particle_files), a("history", histories), a("checkpoint", checkpoints);
  a("initial_energy", initial_energy), a("initial_block_energy", initial_block_energy), a("dt", dt);
  a("monitor", monitor);
}

/// A run in a grid, with the blocks in it.
template <int Dim>
CheckpointWriter save_state(RunState state, System<Dim>& system, Stepper<Dim>& stepper);
/// Fills a freshly built system. Throws FileError if the checkpoint is of another model.
template <int Dim>
RunState load_state(const Checkpoint& checkpoint, System<Dim>& system, Stepper<Dim>& stepper);

/// A run of blocks without a grid.
CheckpointWriter save_state(RunState state, Assembly& blocks);
/// Fills a freshly built assembly. Throws FileError if the checkpoint is of another model.
RunState load_state(const Checkpoint& checkpoint, Assembly& blocks);

}  // namespace tribo
