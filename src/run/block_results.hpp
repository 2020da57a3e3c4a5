// SPDX-License-Identifier: MIT
/// What a run of blocks writes.
#pragma once

#include "blocks/assembly.hpp"
#include "model/model.hpp"
#include "output/history.hpp"
#include "output/vtk.hpp"

#include <filesystem>
#include <optional>

namespace tribo {

class BlockResults {
 public:
  /// Starts the files, or continues them after `resume_time`. Beside a grid the energies and events of blocks have
  /// files of their own, block_energy.csv and block_events.csv, and their histories are columns of the grid's file.
  BlockResults(const Model& model, Assembly& blocks, std::filesystem::path folder, std::optional<double> resume_time);

  /// Heads and values of the histories that the model asks for.
  static std::vector<std::string> columns(const Model& model);
  std::vector<double> values(double dt) const;

  /// The blocks as cells and the contacts as facets.
  void write_pictures(std::int64_t number);
  void write_history(double dt);
  /// What happened since the last call.
  void write_events();
  /// Energy at the start, for the residual; kept for restart.
  double initial_energy = 0.0;

 private:
  double quantity(const BlockHistory& q, double dt) const;
  double of_group(const std::string& name, std::size_t group) const;
  void write_blocks(std::int64_t number);
  void write_contacts(std::int64_t number);

  const Model& model_;
  Assembly& blocks_;
  std::filesystem::path folder_;
  Collection cells_, contacts_;
  std::optional<History> history_, energy_, events_;
};

}  // namespace tribo
