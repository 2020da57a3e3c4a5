// SPDX-License-Identifier: MIT
/// Initial stress from a table of points.

#include "base/csv.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tribo {
namespace {

constexpr std::size_t unknown = 9;
const std::vector<std::string> names{"x", "y", "z", "xx", "yy", "zz", "xy", "yz", "xz"};

// Index into the names for each column.
std::vector<std::size_t> read_head(const CsvRow& head, int dimension, Problems& problems) {
  std::vector<std::size_t> meaning;
  for (const auto& cell : head.cells) {
    const auto k = static_cast<std::size_t>(std::find(names.begin(), names.end(), cell.text) - names.begin());
    if (k == unknown)
      problems.add(cell.origin, "a table of stresses has no column '" + cell.text + "'" +
                                    did_you_mean(cell.text, names) + "; valid: " + join(names));
    else if (std::find(meaning.begin(), meaning.end(), k) != meaning.end())
      problems.add(cell.origin, "the column '" + cell.text + "' occurs twice");
    meaning.push_back(k);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    const bool there = std::find(meaning.begin(), meaning.end(), d) != meaning.end();
    const bool wanted = static_cast<int>(d) < dimension;
    if (wanted && !there) problems.add(head.origin, "the column '" + names[d] + "' of the points is missing");
    if (!wanted && there) problems.add(head.origin, "points of a two-dimensional model have no column z");
  }
  if (std::none_of(meaning.begin(), meaning.end(), [](std::size_t k) { return k >= 3; }))
    problems.add(head.origin,
                 "this table has no column with a stress; valid: " + join({names.begin() + 3, names.end()}));
  return meaning;
}

}  // namespace

// The attributes xx to xz and `file`.
StressField Builder::stress_field(const Statement& s) {
  StressField out;
  for (std::size_t k = 0; k < 6; ++k) out.functions[k] = function(s, names[k + 3]);
  out.factor = model_.units.factor(Dimension::stress);
  if (has(s, "file")) out.points = stress_points(s);
  return out;
}

std::shared_ptr<const ScatteredField> Builder::stress_points(const Statement& s) {
  const auto place = data_file(s.attribute("file")->text);
  const auto text = content_of(place, s.attribute("file")->origin);
  if (!text) return nullptr;
  const Origin origin{std::make_shared<const std::string>(place.string()), 1, 1};
  const double length = model_.units.factor(Dimension::length), stress = model_.units.factor(Dimension::stress);
  std::vector<std::size_t> meaning;
  std::vector<Vec3> points;
  std::vector<ScatteredField::Values> values;
  for (const CsvRow& row : read_csv(*text, origin)) {
    if (meaning.empty()) {
      meaning = read_head(row, model_.dimension(), problems_);
      continue;
    }
    if (problems_.full()) break;
    must(row.cells.size() == meaning.size(), row.origin,
         "this row has " + counted(row.cells.size(), "cell") + ", its table has " + counted(meaning.size(), "column"));
    Vec3& x = points.emplace_back(Vec3::Zero());
    auto& v = values.emplace_back();
    for (std::size_t k = 0; k < std::min(row.cells.size(), meaning.size()); ++k) {
      const auto value = to_number(row.cells[k].text);
      must(value && std::isfinite(*value), row.cells[k].origin, "'" + row.cells[k].text + "' is not a number");
      if (meaning[k] < 3)
        x[static_cast<Eigen::Index>(meaning[k])] = length * value.value_or(0);
      else if (meaning[k] < unknown)
        v[meaning[k] - 3] = stress * value.value_or(0);
    }
  }
  must(!points.empty(), origin,
       "a table of stresses needs a line with the names of its columns and at least one point");
  if (points.empty()) return nullptr;
  return std::make_shared<const ScatteredField>(std::move(points), std::move(values), model_.dimension());
}

}  // namespace tribo
