// SPDX-License-Identifier: MIT
/// The commands of the program. Each returns the exit code and throws exceptions that main converts to exit codes.
#pragma once

#include "base/parallel.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

struct Model;

enum ExitCode { done = 0, usage_error = 2, input_error = 3, numerical_error = 4, file_error = 5, stopped_early = 6 };

struct Arguments {
  std::filesystem::path file, output, folder;
  int thread_count = threads();
  bool quiet = false, overwrite = false, only_check = false, changed = false, accept_edits = false;
  double max_wall = 0.0;              ///< seconds
  std::int64_t max_steps = 0;         ///< 0: no limit
  int rank_count = 0;                 ///< check: processes for which a run is planned; 0: none
  std::vector<std::string> settings;  ///< name=value
  std::string keyword;
  bool markdown = false, coverage = false, names = false;
  std::string field, view;  ///< empty: chosen by the run
  std::vector<double> times, range;
  std::vector<double> window, centre;  ///< render: what a picture shows
  std::optional<double> zoom;          ///< render: magnification
  int width = 900, rate = 20, port = 0;
  std::vector<std::string> variations;  ///< sweep: name=value,value,...
  int jobs = 1, threads_each = 0;       ///< sweep: processes at a time; threads of each, 0: shared among them
  std::string command_line;
};

/// Writes a text to the standard output; returns `done`. Throws FileError, also if the disk behind it is full.
int print(const std::string& text);

int run_command(const Arguments& a);
int resume_command(const Arguments& a);
int check_command(const Arguments& a);
int drive_command(const Arguments& a);
int sweep_command(const Arguments& a);
int safety_command(const Arguments& a);
int convert_command(const Arguments& a);
int list_command(const Arguments& a);
int doc_command(const Arguments& a);

/// The model of the command file of the arguments; prints its warnings. Throws InputError, FileError.
Model model_of_file(const Arguments& a);

// show_commands.cpp
int render_command(const Arguments& a);
int report_command(const Arguments& a);
int watch_command(const Arguments& a);
int view_command(const Arguments& a);

}  // namespace tribo
