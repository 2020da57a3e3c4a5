// SPDX-License-Identifier: MIT
#include "output/history.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"
#include "output/output_queue.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>

namespace tribo {
namespace {

std::string header(const std::vector<std::string>& columns) {
  std::string line;
  for (const auto& column : columns) {
    if (!line.empty()) line += ',';
    if (column.find_first_of(",\"\n") == std::string::npos) {
      line += column;
      continue;
    }
    line += '"';
    for (const char c : column) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + '\n';
}

}  // namespace

void History::open(const char* mode) {
  std::FILE* const file = std::fopen(path_.c_str(), mode);
  if (!file) throw FileError("cannot write '" + path_.string() + "': " + std::strerror(errno));
  file_.reset(file, std::fclose);
}

History::History(std::filesystem::path path, const std::vector<std::string>& columns, OutputQueue* queue)
    : path_(std::move(path)), columns_(columns), queue_(queue) {
  write_atomically(path_, header(columns));
  open("ab");
}

History History::resume(std::filesystem::path path, const std::vector<std::string>& columns, double time,
                        OutputQueue* queue) {
  std::istringstream file(read_file(path, std::uintmax_t{1} << 40));
  std::string kept, line;
  std::getline(file, line);
  if (line + '\n' != header(columns))
    throw FileError("'" + path.string() + "' has other columns than this run; it belongs to another command file");
  kept = line + '\n';
  while (std::getline(file, line) && !file.eof())  // a last line without line end is incomplete
    if (parse_number(line) <= time) kept += line + '\n';
  write_atomically(path, kept);
  History history;
  history.path_ = std::move(path);
  history.columns_ = columns, history.queue_ = queue;
  history.open("ab");
  return history;
}

void History::add(std::span<const double> row) {
  if (row.size() != columns_.size()) throw std::logic_error("a history row needs one value per column");
  std::string line;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (!std::isfinite(row[k])) refuse(k, row[0]);
    if (!line.empty()) line += ',';
    line += number_text(row[k]);
  }
  write(line + '\n');
}

void History::add(double time, std::span<const std::string> rest) {
  if (rest.size() + 1 != columns_.size()) throw std::logic_error("a history row needs one value per column");
  std::string line = number_text(time);
  if (!std::isfinite(time)) refuse(0, time);
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (rest[k] == "inf" || rest[k] == "-inf" || rest[k].ends_with("nan")) refuse(k + 1, time);
    line += ',' + rest[k];
  }
  write(line + '\n');
}

void History::refuse(std::size_t column, double time) const {
  throw SimulationError("'" + columns_[column] + "' is not a number at time " + number_text(time) +
                        ", and is not written to '" + path_.string() +
                        "'; usually the step is too large: try a smaller <TimeFactor>");
}

void History::write(std::string line) {
  const std::size_t bytes = line.size();
  const auto job = [file = file_, path = path_, line = std::move(line)] {
    if (std::fwrite(line.data(), 1, line.size(), file.get()) != line.size() || std::fflush(file.get()) != 0)
      throw FileError("cannot write '" + path.string() + "': " + std::strerror(errno));
  };
  if (!queue_) return job();
  queue_->add(bytes, job);
}

}  // namespace tribo
