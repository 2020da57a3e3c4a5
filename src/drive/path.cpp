// SPDX-License-Identifier: MIT
#include "drive/path.hpp"

#include "base/csv.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Meaning of the columns of the table.
struct Head {
  static constexpr int dt = -1, steps = -2, unknown = -3;
  std::vector<int> meaning;
  bool has(int what) const { return std::find(meaning.begin(), meaning.end(), what) != meaning.end(); }
};

Head read_head(const CsvRow& names, const std::vector<PathColumn>& columns, Problems& problems) {
  std::vector<std::string> valid{"dt", "steps"};
  for (const auto& c : columns) valid.emplace_back(c.name);
  Head head;
  for (const auto& cell : names.cells) {
    int meaning = Head::unknown;
    if (cell.text == "dt") meaning = Head::dt;
    if (cell.text == "steps") meaning = Head::steps;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == cell.text) meaning = static_cast<int>(k);
    if (meaning == Head::unknown)
      problems.add(cell.origin, "a path has no column '" + cell.text + "'" + did_you_mean(cell.text, valid) +
                                    "; valid: " + join(valid));
    else if (head.has(meaning))
      problems.add(cell.origin, "the column '" + cell.text + "' is there twice");
    head.meaning.push_back(meaning);
  }
  if (!head.has(Head::dt)) problems.add(names.origin, "a path needs the column 'dt', the time step");
  return head;
}

void set_value(PathRow& row, int meaning, double value, const std::vector<PathColumn>& columns, double time,
               const Origin& origin, Problems& problems) {
  if (meaning == Head::dt) {
    row.dt = value * time;
    if (!(value > 0) || !std::isfinite(value)) problems.add(origin, "a time step must be positive");
  } else if (meaning == Head::steps) {
    if (!(value >= 1) || value != std::floor(value) || value > 1e7)
      problems.add(origin, "'steps' is a whole number from 1 to 1e7");
    else
      row.steps = static_cast<int>(value);
  } else {
    const auto k = static_cast<std::size_t>(meaning);
    row.value[k] = value * columns[k].factor;
  }
}

}  // namespace

std::string place(const PathRow& row) {
  const std::string text = row.origin.text();
  return text.empty() ? text : text + ": ";
}

std::vector<PathRow> read_path(std::string_view text, const Origin& origin, const std::vector<PathColumn>& columns,
                               double time, Problems& problems) {
  std::vector<PathRow> rows;
  Head head;
  for (const CsvRow& line : read_csv(text, origin)) {
    if (head.meaning.empty()) {
      head = read_head(line, columns, problems);
      continue;
    }
    PathRow row;
    row.origin = line.origin;
    row.value.assign(columns.size(), nothing);
    if (line.cells.size() != head.meaning.size()) {
      problems.add(line.origin, "this row has " + counted(line.cells.size(), "cell") + ", its table has " +
                                    counted(head.meaning.size(), "column"));
      continue;
    }
    for (std::size_t k = 0; k < line.cells.size(); ++k) {
      const CsvCell& cell = line.cells[k];
      const int meaning = head.meaning[k];
      if (meaning == Head::unknown) continue;
      if (cell.text.empty()) {
        if (meaning == Head::dt) problems.add(cell.origin, "this row needs a time step");
        continue;
      }
      const auto value = to_number(cell.text);
      if (!value || !std::isfinite(*value))
        problems.add(cell.origin, "'" + cell.text + "' is no number");
      else
        set_value(row, meaning, *value, columns, time, cell.origin, problems);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) problems.add(origin, "a path needs a line with the names of its columns and at least one row");
  return rows;
}

}  // namespace tribo
