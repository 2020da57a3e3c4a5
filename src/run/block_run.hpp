// SPDX-License-Identifier: MIT
/// Runs of models of rigid blocks.
#pragma once

#include "blocks/assembly.hpp"
#include "run/simulation.hpp"

namespace tribo {

/// Blocks and contacts of a model. Throws InputError.
Assembly assemble(const Model& model);

/// Size and number of the steps of a run.
struct BlockSteps {
  double size = 0.0;
  std::int64_t count = 0;
};
BlockSteps steps_of(const Model& model, const Assembly& blocks);

/// Runs the blocks and writes blocks.pvd, contacts.pvd, events.csv, history.csv, energy.csv, provenance.json and
/// checkpoint.bin into the folder, which is ready. As `run` otherwise.
Outcome run_blocks(const Model& model, Assembly& blocks, const RunOptions& options);

/// The pre-flight sheet of a model of blocks. Throws InputError.
std::string describe_blocks(const Model& model, int threads);

/// More threads than this for so many contacts only wait for each other.
int sensible_block_threads(int wanted, std::size_t contacts);

}  // namespace tribo
