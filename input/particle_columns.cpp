// SPDX-License-Identifier: MIT
#include "input/particle_columns.hpp"

#include "base/csv.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "geometry/point_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace tribo {
namespace {

bool is_among(const std::string& name, const std::vector<std::string>& list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

void read_names(const CsvRow& head, const std::vector<std::string>& valid, ParticleColumns& out, Problems& problems) {
  for (const auto& cell : head.cells) {
    if (!is_among(cell.text, valid))
      problems.add(cell.origin, "a table of particles of this material has no column '" + cell.text + "'" +
                                    did_you_mean(cell.text, valid) + "; valid: " + join(valid));
    else if (out.find(cell.text))
      problems.add(cell.origin, "the column '" + cell.text + "' occurs twice");
    out.columns.push_back({cell.text, cell.origin, {}, {}});
  }
}

}  // namespace

const ParticleColumns::Column* ParticleColumns::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Origin ParticleColumns::place(const Column& column, std::size_t particle) const {
  return lines.empty() ? file : Origin{file.file, lines[particle], column.places[particle]};
}

std::string ParticleColumns::which(std::size_t particle) const {
  return lines.empty() ? " of particle " + std::to_string(particle + 1) : std::string();
}

ParticleColumns particle_columns_of_text(std::string_view text, const std::string& path,
                                         const std::vector<std::string>& valid, Problems& problems) {
  ParticleColumns out;
  out.file.file = std::make_shared<const std::string>(path);
  bool head = true;
  for (const CsvRow& row : read_csv(text, {out.file.file, 1, 1})) {
    if (std::exchange(head, false)) {
      read_names(row, valid, out, problems);
      continue;
    }
    if (problems.full()) break;
    if (row.cells.size() != out.columns.size()) {
      problems.add(row.origin, "this row has " + counted(row.cells.size(), "cell") + ", its table has " +
                                   counted(out.columns.size(), "column"));
      continue;
    }
    out.lines.push_back(row.origin.line), ++out.count;
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const auto value = to_number(row.cells[k].text);
      if (!value || !std::isfinite(*value))
        problems.add(row.cells[k].origin, "'" + row.cells[k].text + "' is not a number; a number is needed in '" +
                                              out.columns[k].name + "'");
      out.columns[k].values.push_back(value.value_or(0)), out.columns[k].places.push_back(row.cells[k].origin.column);
    }
  }
  if (out.count == 0 && problems.empty())
    problems.add(out.file, "a table of particles needs a line with the names of its columns and at least one row");
  return out;
}

ParticleColumns particle_columns_of_vtk(const std::string& path, const std::vector<std::string>& valid) {
  static const std::map<std::string, std::vector<std::string>> parts{{"velocity", {"vx", "vy", "vz"}},
                                                                     {"stress", {"xx", "yy", "zz", "xy", "yz", "xz"}},
                                                                     {"size", {"size_x", "size_y", "size_z"}}};
  const PointFile points = read_point_file(path);
  ParticleColumns out;
  out.file.file = std::make_shared<const std::string>(path);
  out.count = points.position.size();
  const auto add = [&](const std::string& name, auto&& value) {
    if (!is_among(name, valid)) return;
    auto& column = out.columns.emplace_back(ParticleColumns::Column{name, out.file, {}, {}});
    for (std::size_t i = 0; i < out.count; ++i) column.values.push_back(value(i));
  };
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t d = 0; d < 3; ++d)
    add(axes[d], [&](std::size_t i) { return points.position[i][static_cast<Eigen::Index>(d)]; });
  for (const auto& array : points.arrays) {
    const auto found = parts.find(array.name);
    const auto component = [&](std::size_t k) {
      return [&array, k](std::size_t i) { return array.values[array.components * i + k]; };
    };
    constexpr std::array<std::size_t, 6> of_nine{0, 4, 8, 1, 5, 2};  // the components of a symmetric tensor in all nine
    if (found != parts.end() && array.components == found->second.size())
      for (std::size_t k = 0; k < array.components; ++k) add(found->second[k], component(k));
    else if (array.name == "stress" && array.components == 9)
      for (std::size_t k = 0; k < 6; ++k) add(found->second[k], component(of_nine[k]));
    else if (array.components == 1)
      add(array.name, component(0));
  }
  return out;
}

}  // namespace tribo
