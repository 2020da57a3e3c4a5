// SPDX-License-Identifier: MIT
#include "base/csv.hpp"

#include <algorithm>
#include <cctype>

namespace tribo {
namespace {

std::vector<CsvCell> cells(std::string_view line, const Origin& at) {
  std::vector<CsvCell> out;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin, last = end;
    while (first < last && std::isspace(static_cast<unsigned char>(line[first]))) ++first;
    while (last > first && std::isspace(static_cast<unsigned char>(line[last - 1]))) --last;
    out.push_back(
        {std::string(line.substr(first, last - first)), {at.file, at.line, at.column + static_cast<int>(first)}});
    begin = end + 1;
  }
  return out;
}

}  // namespace

std::vector<CsvRow> read_csv(std::string_view text, const Origin& origin) {
  std::vector<CsvRow> rows;
  Origin at = origin;
  for (std::size_t begin = 0; begin < text.size(); ++at.line, at.column = 1) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    auto row = cells(line.substr(0, std::min(line.find('#'), line.size())), at);
    if (row.size() > 1 || !row[0].text.empty()) rows.push_back({std::move(row), at});
  }
  return rows;
}

}  // namespace tribo
