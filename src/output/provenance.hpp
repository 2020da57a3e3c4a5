// SPDX-License-Identifier: MIT
/// Origin of results: the file provenance.json in their folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tribo {

/// Version, commit, compiler and instruction set this program was built with; one line for --version.
std::string version_text();

/// The contents of a file as a short text.
std::string file_checksum(const std::filesystem::path& path);

/// A body and the numbers of its particles, from the first to the last.
struct RecordedBody {
  std::string name;
  std::int64_t first = 0, last = 0;
};

/// Units and names.
struct RecordedLegend {
  std::map<std::string, std::string> units;  ///< of fields and columns
  std::vector<std::string> materials;        ///< by their number
  std::vector<std::string> rigid_materials;
  std::vector<RecordedBody> bodies;
  std::vector<std::string> block_groups;  ///< by their number
};

class Provenance {
 public:
  /// Starts the record of a run. `facts`: further names and values, e.g. particles per material.
  Provenance(std::filesystem::path path, std::string command_line, const std::filesystem::path& input, int threads,
             std::map<std::string, std::string> facts);
  /// Writes the file with a status: running, finished, stopped, failed, and the reason. On a full disk it is written
  /// over the old record. Throws FileError.
  void write(const std::string& status, const std::string& reason, double time, long step) const;

  /// What pictures and reports write next to numbers.
  void set_legend(RecordedLegend legend) { legend_ = std::move(legend); }
  /// What the run has noticed about its own results, and figures that need not be wrong, for the next write().
  void set_remarks(std::vector<std::string> remarks, std::vector<std::string> figures) {
    remarks_ = std::move(remarks), figures_ = std::move(figures);
  }
  /// Progress of the run and its computing time, for the next write().
  struct Progress {
    double end_time = 0.0, step = 0.0;              ///< simulated
    double seconds = 0.0, seconds_left = 0.0;       ///< of wall time, since the start or resumption
    std::map<std::string, double> seconds_of = {};  ///< by part of the program
    double seconds_writing = 0.0;                   ///< of the thread that writes files, beside the others
  };
  void set_progress(Progress progress) { progress_ = std::move(progress); }

 private:
  std::filesystem::path path_;
  std::string command_line_, input_, input_checksum_, started_;
  int threads_;
  std::map<std::string, std::string> facts_;
  RecordedLegend legend_;
  std::vector<std::string> remarks_, figures_;
  Progress progress_;
};

}  // namespace tribo
