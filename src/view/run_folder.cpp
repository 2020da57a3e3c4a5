// SPDX-License-Identifier: MIT
#include "view/run_folder.hpp"

#include "base/read_file.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace tribo {
namespace {

// Cells between commas; a cell in quotes may hold commas, and quotes twice.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"')
      out.back() += '"', ++k;
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

}  // namespace

const std::vector<double>* ResultTable::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

ResultTable read_table(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  ResultTable table;
  std::size_t number = 0;
  const auto fail = [&](const std::string& why) {
    throw FileError("the file '" + printable(file.string()) + "' is damaged: line " + std::to_string(number) + ": " +
                    why);
  };
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = text.find('\n', begin);
    if (end == std::string::npos) break;  // still being written
    const auto row = cells(text.substr(begin, end - begin));
    begin = end + 1;
    if (++number == 1) {
      table.names = row;
      table.columns.resize(row.size());
      continue;
    }
    if (row.size() != table.names.size())
      fail(counted(row.size(), "cell") + ", not " + std::to_string(table.names.size()));
    for (std::size_t k = 0; k < row.size(); ++k) {
      double value = 0;  // nan and inf are numbers here
      const auto [last, error] = std::from_chars(row[k].data(), row[k].data() + row[k].size(), value);
      if (error != std::errc() || last != row[k].data() + row[k].size())
        fail("'" + printable(row[k]) + "' is not a number");
      table.columns[k].push_back(value);
    }
  }
  if (number == 0) throw FileError("the file '" + printable(file.string()) + "' is damaged: it has no head");
  return table;
}

RunFolder::RunFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (!has_particles() && !std::filesystem::exists(folder_ / "blocks.pvd"))
    throw FileError("'" + folder_.string() + "' is not the folder of a run: it has no run.pvd and no blocks.pvd");
}

bool RunFolder::has_particles() const { return std::filesystem::exists(folder_ / "run.pvd"); }

std::vector<CollectionEntry> RunFolder::frames() const {
  return read_collection(folder_ / (has_particles() ? "run.pvd" : "blocks.pvd"));
}

namespace {

// Rigid bodies move and touch, but have no stress or strain.
bool rigid_bodies_have(const std::string& field) {
  static const std::set<std::string> all{"velocity", "displacement", "material", "id", "mass", "temperature"};
  return all.contains(field) || field.starts_with("contact");
}

}  // namespace

void remove_values_of_rigid_materials(ParticleFrame& frame, const Legend& legend) {
  const auto* material = frame.field("material");
  if (legend.rigid_materials.empty() || !material) return;
  const std::vector<double> of_particle = material->values;
  const auto is_rigid = [&](double number) {
    const auto k = static_cast<std::size_t>(number) - 1;
    return k < legend.materials.size() && std::find(legend.rigid_materials.begin(), legend.rigid_materials.end(),
                                                    legend.materials[k]) != legend.rigid_materials.end();
  };
  for (auto& field : frame.fields) {
    if (rigid_bodies_have(field.name)) continue;
    const auto count = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < of_particle.size(); ++i)
      if (is_rigid(of_particle[i]))
        std::fill_n(field.values.begin() + static_cast<std::ptrdiff_t>(i * count), count, std::nan(""));
  }
}

void add_bodies(ParticleFrame& frame, const Legend& legend) {
  const auto* id = frame.field("id");
  if (legend.bodies.empty() || !id || frame.field("body")) return;
  ParticleFrame::Field body{"body", 1, true, {}};
  for (const double number : id->values) {
    // The bodies are in the order of the numbers.
    const auto after = std::upper_bound(legend.bodies.begin(), legend.bodies.end(), number,
                                        [](double n, const Legend::Body& b) { return n < b.first; });
    const bool inside = after != legend.bodies.begin() && number <= std::prev(after)->last;
    body.values.push_back(inside ? static_cast<double>(after - legend.bodies.begin()) : 0.0);
  }
  frame.fields.push_back(std::move(body));
}

// Files that belong together have the same number in their folders.
Scene RunFolder::scene(const CollectionEntry& frame) const {
  Scene scene;
  scene.time = frame.time;
  if (has_particles()) scene.particles = read_particles(frame.file);
  if (std::filesystem::exists(folder_ / "provenance.json")) {
    const Legend names = legend();
    remove_values_of_rigid_materials(scene.particles, names);
    add_bodies(scene.particles, names);
  }
  const auto cells = [&](const char* part) {
    const auto file = folder_ / part / frame.file.filename().replace_extension(".vtp");
    return std::filesystem::exists(file) ? read_cells(file) : CellFrame{};
  };
  scene.blocks = cells("blocks"), scene.contacts = cells("contacts"), scene.cracks = cells("cracks");
  return scene;
}

std::string RunFolder::provenance() const { return read_file(folder_ / "provenance.json"); }

FileError damaged_record(const std::filesystem::path& folder, const std::string& why) {
  return FileError("the file '" + printable((folder / "provenance.json").string()) + "' is damaged: " + printable(why));
}

std::string Legend::unit_of(const std::string& name) const {
  const auto whole = units.find(name),
             found = whole != units.end() ? whole : units.find(name.substr(0, name.find('.')));
  return found == units.end() ? "" : found->second;
}

Legend RunFolder::legend() const {
  using Json = nlohmann::json;
  Legend out;
  try {
    const Json record = Json::parse(provenance());
    const Json model = record.value("model", Json::object());
    out.time = model.value("unit of time", ""), out.length = model.value("unit of length", "");
    out.units = record.value("unit_of", out.units);
    out.materials = record.value("materials", out.materials);
    for (const Json& body : record.value("bodies", Json::array()))
      out.bodies.push_back({body.at("name"), body.at("first"), body.at("last")});
    out.rigid_materials = record.value("rigid_materials", out.rigid_materials);
  } catch (const Json::exception& error) {
    throw damaged_record(folder_, error.what());
  }
  return out;
}

}  // namespace tribo
