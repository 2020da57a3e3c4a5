// SPDX-License-Identifier: MIT
/// The files of results of blocks.
#pragma once

#include "blocks/assembly.hpp"
#include "model/model.hpp"
#include "output/history.hpp"
#include "output/output_queue.hpp"
#include "output/vtk.hpp"
#include "run/result_folder.hpp"

#include <filesystem>
#include <optional>

namespace tribo {

class BlockResults {
 public:
  /// Starts the files, or continues them after `resume_time`. In a model with a grid the energies and events of blocks
  /// have files of their own, block_energy.csv and block_events.csv, and their histories are columns of history.csv.
  /// Files are written by jobs of the queue, from copies of the state.
  BlockResults(const Model& model, Assembly& blocks, std::filesystem::path folder, std::optional<double> resume_time,
               OutputQueue& queue);

  /// What it writes.
  static ResultNames names(const Model& model);
  /// Column names and values of the histories of the model.
  static std::vector<std::string> columns(const Model& model);
  std::vector<double> values(double dt) const;

  /// The blocks as cells and the contacts as facets.
  void write_files(std::int64_t number);
  void write_history(double dt);
  /// The events since the last call.
  void write_events();
  /// Content of energy at the start, for the residual [energy]. Found by the constructor for a new run; to be set for
  /// one that is continued.
  double initial_energy = 0.0;
  /// The last row of the histories of a model of blocks alone: the time and the values.
  const std::vector<double>& last_row() const { return row_; }
  std::int64_t breaks = 0;  ///< bonds that broke according to the events written by this object
  double stages = 0.0;      ///< energy that stages have brought, in a model of blocks alone [energy]

 private:
  void write_blocks(std::int64_t number);
  void write_contacts(std::int64_t number);

  const Model& model_;
  Assembly& blocks_;
  std::filesystem::path folder_;
  OutputQueue& queue_;
  Collection cells_, contacts_;
  std::optional<History> history_, energy_, events_;
  std::vector<double> row_;
};

}  // namespace tribo
