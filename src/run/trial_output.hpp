// SPDX-License-Identifier: MIT
/// A folder for trial output, and the time that output takes.
#pragma once

#include "base/error.hpp"
#include "run/schedule.hpp"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>

namespace tribo {

/// A folder for results, of this object alone, that is removed at the end. Throws FileError.
struct TrialFolder {
  std::filesystem::path path;
  TrialFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tribo-check-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw FileError("cannot create '" + name + "': " + std::strerror(errno));
    path = name;
    for (const char* part : {"particles", "grid", "cracks", "joints", "blocks", "contacts"})
      std::filesystem::create_directory(path / part);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  ~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

/// Number of output times up to `end`.
inline double output_times(Schedule schedule, double end) {
  schedule.due(end, 0.0);
  return static_cast<double>(schedule.count());
}

/// Number of times at which a run writes files: the output times, and the end if it is none of them.
inline double file_times(const Schedule& schedule, double end) {
  constexpr double round_off = 1e-9;
  const double all = output_times(schedule, end * (1 + round_off));
  return all + (output_times(schedule, end * (1 - round_off)) == all ? 1.0 : 0.0);
}

/// Seconds that all output of a run will take, from one set of files and one row of the histories. `end`: of the run.
template <class Files, class Row>
double seconds_of_output(const OutputSpec& output, double end, Files&& write_files, Row&& write_row) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  write_files();
  const auto middle = Clock::now();
  write_row();
  const std::chrono::duration<double> files = middle - begin, row = Clock::now() - middle;
  const double times = file_times(Schedule(output.archive), end);
  const double rows = output.history_interval > 0 ? output_times(Schedule::every(output.history_interval), end) : times;
  return times * files.count() + rows * row.count();
}

}  // namespace tribo
