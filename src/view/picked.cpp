// SPDX-License-Identifier: MIT
#include "view/picked.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace tribo {
namespace {

using Json = nlohmann::json;
using Fields = std::vector<ParticleFrame::Field>;
using Place = std::array<double, 3>;

/// A row of a table of fields.
struct Row {
  const Fields* fields = nullptr;
  std::size_t index = 0;
  Place place{};
};

Place centre_of(const CellFrame& frame, std::size_t c) {
  Place out{};
  for (const auto k : frame.cells[c])
    for (std::size_t d = 0; d < 3; ++d) out[d] += frame.position[k][d] / static_cast<double>(frame.cells[c].size());
  return out;
}

std::optional<std::size_t> index_of(const ParticleFrame::Field* field, double number) {
  if (!field) return std::nullopt;
  const auto found = std::find(field->values.begin(), field->values.end(), number);
  if (found == field->values.end()) return std::nullopt;
  return static_cast<std::size_t>(found - field->values.begin());
}

std::optional<std::size_t> contact_of(const CellFrame& contacts, const std::array<double, 2>& blocks) {
  const auto *one = contacts.field("block1"), *other = contacts.field("block2");
  for (std::size_t c = 0; one && other && c < contacts.count(); ++c)
    if (one->values[c] == blocks[0] && other->values[c] == blocks[1]) return c;
  return std::nullopt;
}

std::optional<Row> row_of(const Scene& scene, const Picked& what) {
  const auto row = [](const auto& frame, std::optional<std::size_t> k, const auto& place) -> std::optional<Row> {
    if (!k) return std::nullopt;
    return Row{&frame.fields, *k, place(*k)};
  };
  if (what.kind == Picked::Kind::particle)
    return row(scene.particles, index_of(scene.particles.field("id"), what.numbers[0]),
               [&](std::size_t k) { return scene.particles.position[k]; });
  const bool block = what.kind == Picked::Kind::block;
  const CellFrame& cells = block ? scene.blocks : scene.contacts;
  return row(cells, block ? index_of(cells.field("block"), what.numbers[0]) : contact_of(cells, what.numbers),
             [&](std::size_t k) { return centre_of(cells, k); });
}

std::vector<std::string> components_of(int count) {
  switch (count) {
    case 3:
      return {"x", "y", "z"};
    case 6:
      return {"xx", "yy", "zz", "xy", "yz", "xz"};
    case 9:
      return {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
    default:
      return {};
  }
}

std::vector<double> numbers_of(const ParticleFrame::Field& field, std::size_t index) {
  const auto n = static_cast<std::ptrdiff_t>(field.components), from = static_cast<std::ptrdiff_t>(index) * n;
  return {field.values.begin() + from, field.values.begin() + from + n};
}

const char* name_of(Picked::Kind kind) {
  return kind == Picked::Kind::particle ? "particle" : kind == Picked::Kind::block ? "block" : "contact";
}

// The files that are read for a history: so few that the answer does not take long.
std::vector<CollectionEntry> some_of(const std::vector<CollectionEntry>& all, std::size_t particles) {
  static constexpr std::size_t most_files = 250, most_particles = 20000000;
  const std::size_t wanted =
      std::clamp<std::size_t>(most_particles / std::max<std::size_t>(1, particles), 8, most_files);
  if (all.size() <= wanted) return all;
  std::vector<CollectionEntry> out;
  for (std::size_t k = 0; k < wanted; ++k) out.push_back(all[k * (all.size() - 1) / (wanted - 1)]);
  return out;
}

}  // namespace

Picked particle_at(const Scene& scene, std::size_t index) {
  const auto* id = scene.particles.field("id");
  if (index >= scene.particles.count()) throw UsageError("there is no such particle");
  if (!id) throw UsageError("the files have no field 'id', by which a particle is known");
  return {Picked::Kind::particle, {id->values[index], 0.0}};
}

std::optional<Picked> contact_near(const Scene& scene, const std::array<double, 3>& point) {
  const CellFrame& contacts = scene.contacts;
  const auto *one = contacts.field("block1"), *other = contacts.field("block2");
  if (!one || !other) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  std::optional<Picked> out;
  for (std::size_t c = 0; c < contacts.count(); ++c) {
    const Place x = centre_of(contacts, c);
    const double distance = std::hypot(x[0] - point[0], x[1] - point[1], x[2] - point[2]);
    if (distance < least) least = distance, out = Picked{Picked::Kind::contact, {one->values[c], other->values[c]}};
  }
  return out;
}

nlohmann::json values_of(const Scene& scene, const Legend& legend, const Picked& what) {
  const auto row = row_of(scene, what);
  if (!row) return nullptr;
  Json fields = Json::array();
  for (const auto& field : *row->fields)
    fields.push_back({{"name", field.name},
                      {"unit", legend.unit_of(field.name)},
                      {"components", components_of(field.components)},
                      {"values", numbers_of(field, row->index)}});
  Json out{{"kind", name_of(what.kind)}, {"numbers", what.numbers}, {"place", row->place}, {"fields", fields}};
  const auto* material = what.kind == Picked::Kind::particle ? scene.particles.field("material") : nullptr;
  if (const auto k = material ? static_cast<std::size_t>(material->values[row->index]) : 0;
      k > 0 && k <= legend.materials.size())
    out["material"] = legend.materials[k - 1];
  return out;
}

nlohmann::json history_of(const RunFolder& run, const Picked& what) {
  const auto all = run.frames();
  if (all.empty()) throw FileError("the run has written no files yet");
  const Legend legend = run.legend();
  std::vector<double> times;
  Json fields = Json::object();
  std::size_t particles = 0;
  std::vector<CollectionEntry> files{all.back()};
  particles = run.scene(files.front()).particles.count();
  files = some_of(all, particles);
  for (const auto& entry : files) {
    const Scene scene = run.scene(entry);
    const auto row = row_of(scene, what);
    const auto add = [&](const std::string& name, const std::string& unit, double value) {
      Json& field = fields[name];
      if (field.is_null()) field = {{"unit", unit}, {"values", Json::array()}};
      Json& list = field["values"];
      while (list.size() < times.size()) list.push_back(nullptr);
      list.push_back(value);
    };
    if (row) {
      for (std::size_t d = 0; d < 3; ++d) add(std::string("position.") + "xyz"[d], legend.length, row->place[d]);
      for (const auto& field : *row->fields) {
        const auto names = components_of(field.components);
        const auto numbers = numbers_of(field, row->index);
        for (std::size_t d = 0; d < numbers.size(); ++d)
          add(names.empty() ? field.name : field.name + "." + names[d], legend.unit_of(field.name), numbers[d]);
      }
    }
    times.push_back(entry.time);
  }
  for (auto& [name, field] : fields.items())
    while (field["values"].size() < times.size()) field["values"].push_back(nullptr);
  return {{"times", times}, {"time_unit", legend.time}, {"files", all.size()}, {"fields", fields}};
}

}  // namespace tribo
