#include "drive/path.hpp"

#include "base/schema.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

struct Cell {
  std::string text;
  int column;  // of the line, from 1
};

std::vector<Cell> cells(std::string_view line) {
  std::vector<Cell> out;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin, last = end;
    while (first < last && std::isspace(static_cast<unsigned char>(line[first]))) ++first;
    while (last > first && std::isspace(static_cast<unsigned char>(line[last - 1]))) --last;
    out.push_back({std::string(line.substr(first, last - first)), static_cast<int>(first) + 1});
    begin = end + 1;
  }
  return out;
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// What the columns of the table mean.
struct Head {
  static constexpr int dt = -1, steps = -2, unknown = -3;
  std::vector<int> meaning;
  bool has(int what) const { return std::find(meaning.begin(), meaning.end(), what) != meaning.end(); }
};

Head read_head(const std::vector<Cell>& names, const std::vector<PathColumn>& columns, const Origin& at,
               Problems& problems) {
  std::vector<std::string> valid{"dt", "steps"};
  for (const auto& c : columns) valid.emplace_back(c.name);
  Head head;
  for (const auto& cell : names) {
    const Origin origin{at.file, at.line, at.column + cell.column - 1};
    int meaning = Head::unknown;
    if (cell.text == "dt") meaning = Head::dt;
    if (cell.text == "steps") meaning = Head::steps;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == cell.text) meaning = static_cast<int>(k);
    if (meaning == Head::unknown)
      problems.add(origin, "a path has no column '" + cell.text + "'" + did_you_mean(cell.text, valid) +
                               "; valid: " + join(valid));
    else if (head.has(meaning))
      problems.add(origin, "the column '" + cell.text + "' is there twice");
    head.meaning.push_back(meaning);
  }
  if (!head.has(Head::dt)) problems.add(at, "a path needs the column 'dt', the time step");
  return head;
}

void set_value(PathRow& row, int meaning, double value, const std::vector<PathColumn>& columns, double time,
               const Origin& origin, Problems& problems) {
  if (meaning == Head::dt) {
    row.dt = value * time;
    if (!(value > 0) || !std::isfinite(value)) problems.add(origin, "a time step must be positive");
  } else if (meaning == Head::steps) {
    if (!(value >= 1) || value != std::floor(value) || value > 1e9)
      problems.add(origin, "'steps' is a whole number from 1 on");
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
  Origin at = origin;
  for (std::size_t begin = 0; begin < text.size(); ++at.line, at.column = 1) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    const auto row_cells = cells(line.substr(0, std::min(line.find('#'), line.size())));
    if (row_cells.size() == 1 && row_cells[0].text.empty()) continue;
    if (head.meaning.empty()) {
      head = read_head(row_cells, columns, at, problems);
      continue;
    }
    PathRow row;
    row.origin = at;
    row.value.assign(columns.size(), nothing);
    if (row_cells.size() != head.meaning.size()) {
      problems.add(at, "this row has " + std::to_string(row_cells.size()) + " cells, its table has " +
                           std::to_string(head.meaning.size()) + " columns");
      continue;
    }
    for (std::size_t k = 0; k < row_cells.size(); ++k) {
      const Origin place{at.file, at.line, at.column + row_cells[k].column - 1};
      const int meaning = head.meaning[k];
      if (meaning == Head::unknown) continue;
      if (row_cells[k].text.empty()) {
        if (meaning == Head::dt) problems.add(place, "this row needs a time step");
        continue;
      }
      const auto value = to_number(row_cells[k].text);
      if (!value || !std::isfinite(*value))
        problems.add(place, "'" + row_cells[k].text + "' is no number");
      else
        set_value(row, meaning, *value, columns, time, place, problems);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) problems.add(origin, "a path needs a line with the names of its columns and at least one row");
  return rows;
}

}  // namespace tribo
