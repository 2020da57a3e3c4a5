// SPDX-License-Identifier: MIT
/// The state of a run as a checkpoint, complete to the bit.
#pragma once

#include "output/checkpoint.hpp"
#include "solver/step.hpp"

namespace tribo {

/// Counters of the run loop.
struct RunState {
  std::int64_t archive = 0, history = 0, checkpoint = 0;  ///< output times already written
  double initial_energy = 0.0;
  double dt = 0.0;
  double initial_block_energy = 0.0;
};

/// Blocks and their contacts; `load_blocks` throws FileError if those of the checkpoint are others.
void save_blocks(Assembly& blocks, double initial_energy, CheckpointWriter& to);
/// Returns the initial energy.
double load_blocks(const Checkpoint& from, Assembly& blocks);

template <int Dim>
CheckpointWriter save_state(const RunState& state, System<Dim>& system, Stepper<Dim>& stepper);

/// Fills a freshly built system; throws FileError if the checkpoint is of another model.
template <int Dim>
RunState load_state(const Checkpoint& checkpoint, System<Dim>& system, Stepper<Dim>& stepper);

}  // namespace tribo
