// SPDX-License-Identifier: MIT
/// <ParticleTable>: a body that is given by its particles.

#include "base/text.hpp"
#include "input/builder.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {
namespace {

const std::vector<std::string> axis_columns{"x", "y", "z"}, size_columns{"size_x", "size_y", "size_z"},
    velocity_columns{"vx", "vy", "vz"}, stress_columns{"xx", "yy", "zz", "xy", "yz", "xz"};

// The names that columns may have: those of a model of this dimension, and the history variables of the material.
std::vector<std::string> column_names(int dimension, const Material* law) {
  std::vector<std::string> out;
  const auto add = [&](const std::vector<std::string>& names, int count) {
    out.insert(out.end(), names.begin(), names.begin() + count);
  };
  add(axis_columns, dimension);
  out.emplace_back("volume"), out.emplace_back("size");
  add(size_columns, dimension);
  out.emplace_back("mass");
  add(velocity_columns, dimension);
  out.emplace_back("temperature");
  if (law && keeps_stress(*law)) add(stress_columns, 6);
  if (law)
    for (const auto& variable : law->history()) out.push_back(variable.name);
  return out;
}

}  // namespace

void Builder::particle_table(const Statement& s) {
  ParticleTable table;
  table.origin = s.origin;
  table.material = material(s);
  must_be_solid(s, table.material);
  table.angle = number(s, "angle", Dimension::angle);
  if (has(s, "temp")) table.temperature = number(s, "temp", Dimension::temperature);
  const std::string path = data_file(word(s, "file")).string(),
                    ending = lower(std::filesystem::path(path).extension().string());
  const Origin& at = s.attribute("file") ? s.attribute("file")->origin : s.origin;
  const Material* law = table.material < static_cast<int>(model_.materials.size())
                            ? model_.materials[static_cast<std::size_t>(table.material)].law.get()
                            : nullptr;
  const auto valid = column_names(model_.dimension(), law);
  ParticleColumns columns;
  try {
    if (ending == ".vtp" || ending == ".vtu" || ending == ".vtk") {
      columns = particle_columns_of_vtk(path, valid);
    } else if (ending == ".csv" || ending == ".txt") {
      const auto text = content_of(path, at);
      if (!text) return;
      Problems found;
      columns = particle_columns_of_text(*text, path, valid, found);
      problems_.add(found);
      if (!found.empty()) return;
    } else {
      problems_.add(
          at, "the name of a table of particles ends with .csv, .txt, .vtp, .vtu or .vtk, not with '" + ending + "'");
      return;
    }
  } catch (const FileError& error) {
    problems_.add(at, error.what());
    return;
  }
  table_columns(columns, table, s);
  model_.tables.push_back(std::move(table));
}

// Fills the lists of the table in consistent units.
void Builder::table_columns(const ParticleColumns& columns, ParticleTable& table, const Statement& s) {
  const auto dimension = static_cast<std::size_t>(model_.dimension());
  const Placement place = placement(s);
  const double length = model_.units.factor(Dimension::length) * place.scale;
  must(place.scale > 0, s.origin, "the factor 'scale' must be positive");
  const auto column_of = [&](const std::string& name) { return columns.find(name); };
  const auto value = [&](const ParticleColumns::Column* column, std::size_t i, double factor, double fallback) {
    return column ? factor * column->values[i] : fallback;
  };
  const auto check_positive = [&](const ParticleColumns::Column* column) {
    for (std::size_t i = 0; column && i < columns.count && !problems_.full(); ++i)
      must(column->values[i] > 0, columns.place(*column, i),
           "the " + column->name + columns.which(i) + " must be positive, not " + format("%g", column->values[i]));
  };
  std::array<const ParticleColumns::Column*, 3> x{}, v{}, edges{};
  for (std::size_t d = 0; d < dimension; ++d) {
    x[d] = column_of(axis_columns[d]), v[d] = column_of(velocity_columns[d]), edges[d] = column_of(size_columns[d]);
    must(x[d] != nullptr, columns.file, "the column '" + axis_columns[d] + "' of the positions is missing");
    check_positive(edges[d]);
  }
  const auto *volume = column_of("volume"), *size = column_of("size"), *mass = column_of("mass"),
             *temperature = column_of("temperature");
  check_positive(volume), check_positive(size), check_positive(mass);
  const auto given = std::count_if(edges.begin(), edges.end(), [](const auto* c) { return c != nullptr; });
  must(given == 0 || static_cast<std::size_t>(given) == dimension, columns.file,
       "the edge lengths size_x, size_y" + std::string(dimension == 3 ? ", size_z" : "") + " are needed together");
  must(given == 0 || !size, columns.file, "the columns 'size' and 'size_x' exclude each other");
  const double usual = has(s, "size") ? number(s, "size", Dimension::length) : 0.0;
  must(volume || size || given > 0 || has(s, "size"), columns.file,
       "the particles have no size; give one of the columns volume, size or size_x, size_y" +
           std::string(dimension == 3 ? ", size_z" : "") + ", or the attribute size of <ParticleTable>");
  must(!has(s, "size") || usual > 0, s.origin, "the particle size must be positive");
  must(!has(s, "size") || (!volume && !size && given == 0), s.origin,
       "the table has the sizes of its particles, and the attribute 'size' is not needed");
  if (!problems_.empty()) return;

  // In the plane the thickness is not that of the file and keeps its length when the coordinates are scaled.
  const bool flat = dimension == 2 && model_.analysis != Analysis::axisymmetric;
  const double volume_factor = length * length * length / (flat ? place.scale : 1.0);
  const double depth = model_.analysis == Analysis::axisymmetric ? 1.0 : model_.grid.thickness;
  const Vec3 common(number(s, "vx", Dimension::velocity), number(s, "vy", Dimension::velocity),
                    number(s, "vz", Dimension::velocity));
  for (std::size_t i = 0; i < columns.count; ++i) {
    Vec3 at = Vec3::Zero(), velocity = common, half = Vec3::Constant(0.5 * depth);
    for (std::size_t d = 0; d < dimension; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      at[k] = length * x[d]->values[i] + place.shift[k];
      velocity[k] = value(v[d], i, model_.units.factor(Dimension::velocity), common[k]);
      half[k] = 0.5 * value(edges[d] ? edges[d] : size, i, length, usual > 0 ? usual : 1.0);
    }
    if (model_.analysis == Analysis::axisymmetric && !(at[0] > 0)) {
      must(false, columns.place(*x[0], i),
           "the radius" + columns.which(i) + " is " + format("%g", at[0]) + "; radii must be positive");
      continue;
    }
    const double radius = model_.analysis == Analysis::axisymmetric ? at[0] : 1.0;
    // The volume is kept as it is given; the domain has it up to round-off.
    double whole = 8.0 * half.prod() * radius;
    if (volume) {
      const double wanted = volume_factor * volume->values[i];
      half.head(model_.dimension()) *= std::pow(wanted / whole, 1.0 / static_cast<double>(dimension));
      whole = wanted;
    }
    table.position.push_back(at), table.velocity.push_back(velocity), table.half_size.push_back(half);
    table.volume.push_back(whole);
    if (mass) table.mass.push_back(model_.units.factor(Dimension::mass) * mass->values[i]);
    if (temperature) table.temperatures.push_back(temperature->values[i]);
  }
  for (std::size_t k = 0; k < stress_columns.size(); ++k)
    if (const auto* c = column_of(stress_columns[k])) {
      table.stress.resize(columns.count, {});
      for (std::size_t i = 0; i < columns.count; ++i)
        table.stress[i][k] = model_.units.factor(Dimension::stress) * c->values[i];
    }
  const auto& law = model_.materials[static_cast<std::size_t>(table.material)].law;
  for (const auto& variable : law->history())
    if (const auto* c = column_of(variable.name)) {
      auto& history = table.histories.emplace_back(ParticleTable::History{variable.name, c->values});
      for (double& h : history.values) h *= model_.units.factor(variable.dimension);
    }
  table.file = columns.file, table.lines = columns.lines;
}

}  // namespace tribo
