// SPDX-License-Identifier: MIT
/// Time histories as CSV.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tribo {

class OutputQueue;

/// A table that grows by rows; the first column is `time`. Every row is flushed as a whole, by a job of the queue if
/// there is one.
class History {
 public:
  /// Starts the file `path` with a header. Column names with commas or quotes are quoted. Throws FileError.
  History(std::filesystem::path path, const std::vector<std::string>& columns, OutputQueue* queue = nullptr);
  /// Continues the file, keeping the rows up to a time; an incomplete last line is dropped. Throws FileError if the
  /// header differs.
  static History resume(std::filesystem::path path, const std::vector<std::string>& columns, double time,
                        OutputQueue* queue = nullptr);

  /// One value per column, `time` first. Throws SimulationError, and writes nothing, if one of them is not finite.
  void add(std::span<const double> row);
  /// The same with text after the time; no value needs quotes. An empty text stands for a quantity that does not exist.
  void add(double time, std::span<const std::string> rest);

 private:
  History() = default;
  void open(const char* mode);
  void write(std::string line);
  [[noreturn]] void refuse(std::size_t column, double time) const;
  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::shared_ptr<std::FILE> file_;  // shared with the jobs
  OutputQueue* queue_ = nullptr;
};

}  // namespace tribo
