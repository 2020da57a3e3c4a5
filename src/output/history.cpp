// SPDX-License-Identifier: MIT
#include "output/history.hpp"

#include "base/error.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

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
  file_.reset(std::fopen(path_.c_str(), mode));
  if (!file_) throw FileError("cannot write '" + path_.string() + "': " + std::strerror(errno));
}

History::History(std::filesystem::path path, const std::vector<std::string>& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  write_atomically(path_, header(columns));
  open("ab");
}

History History::resume(std::filesystem::path path, const std::vector<std::string>& columns, double time) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError("cannot read '" + path.string() + "'");
  std::string kept, line;
  std::getline(file, line);
  if (line + '\n' != header(columns))
    throw FileError("'" + path.string() + "' has other columns than this run; it belongs to another command file");
  kept = line + '\n';
  while (std::getline(file, line) && !file.eof())  // a last line without line end is incomplete
    if (parse_number(line) <= time) kept += line + '\n';
  file.close();
  write_atomically(path, kept);
  History history;
  history.path_ = std::move(path);
  history.columns_ = columns.size();
  history.open("ab");
  return history;
}

void History::add(std::span<const double> row) {
  if (row.size() != columns_) throw std::logic_error("a history row needs one value per column");
  std::string line;
  for (const double value : row) {
    if (!line.empty()) line += ',';
    line += number_text(value);
  }
  write(line + '\n');
}

void History::add(double time, std::span<const std::string> rest) {
  if (rest.size() + 1 != columns_) throw std::logic_error("a history row needs one value per column");
  std::string line = number_text(time);
  for (const auto& value : rest) line += ',' + value;
  write(line + '\n');
}

void History::write(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    throw FileError("cannot write '" + path_.string() + "': " + std::strerror(errno));
}

}  // namespace tribo
