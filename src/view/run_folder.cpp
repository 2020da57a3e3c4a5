// SPDX-License-Identifier: MIT
#include "view/run_folder.hpp"

#include "base/error.hpp"
#include "output/number.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

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

const std::vector<double>* Table::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) throw FileError("cannot read '" + file.string() + "'");
  Table table;
  table.names = cells(line);
  table.columns.resize(table.names.size());
  while (std::getline(in, line)) {
    if (in.eof()) break;  // no end of line: still being written
    const auto row = cells(line);
    if (row.size() != table.names.size()) throw FileError("'" + file.string() + "' is damaged: " + line);
    for (std::size_t k = 0; k < row.size(); ++k) table.columns[k].push_back(parse_number(row[k]));
  }
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

// Files that belong together have the same name in their folders.
Scene RunFolder::scene(const CollectionEntry& frame) const {
  Scene scene;
  scene.time = frame.time;
  if (has_particles()) scene.particles = read_particles(frame.file);
  const auto cells = [&](const char* part) {
    const auto file = folder_ / part / frame.file.filename();
    return std::filesystem::exists(file) ? read_cells(file) : CellFrame{};
  };
  scene.blocks = cells("blocks"), scene.contacts = cells("contacts");
  return scene;
}

std::string RunFolder::provenance() const {
  std::ifstream in(folder_ / "provenance.json");
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw FileError("cannot read '" + (folder_ / "provenance.json").string() + "'");
  return text.str();
}

std::string Legend::unit_of(const std::string& name) const {
  const auto whole = units.find(name),
             found = whole != units.end() ? whole : units.find(name.substr(0, name.find('.')));
  return found == units.end() ? "" : found->second;
}

Legend RunFolder::legend() const {
  using Json = nlohmann::json;
  Legend out;
  const Json record = Json::parse(provenance(), nullptr, false);
  if (!record.is_object()) return out;
  const Json model = record.value("model", Json::object());
  out.time = model.value("unit of time", ""), out.length = model.value("unit of length", "");
  out.units = record.value("unit_of", out.units);
  out.materials = record.value("materials", out.materials);
  return out;
}

}  // namespace tribo
