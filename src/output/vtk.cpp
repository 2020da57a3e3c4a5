// SPDX-License-Identifier: MIT
#include "output/vtk.hpp"

#include "base/finite.hpp"
#include "base/memory.hpp"
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"
#include "output/output_queue.hpp"
#include "output/vtk_xml.hpp"

#include <cmath>
#include <cstring>
#include <functional>

namespace tribo {
namespace {

[[noreturn]] void refuse(const std::string& name, std::size_t row) {
  throw SimulationError("the field '" + name + "' of row " + std::to_string(row) +
                        " of the results is not a number, and is not written; usually the step is too large: try a "
                        "smaller <TimeFactor>");
}

void check_component(const std::string& name, const double* values, std::size_t count) {
  if (!values || all_finite({values, count})) return;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) refuse(name, i);
}

// Components that are separate arrays become rows of numbers.
template <class Number>
void add_rows(VtkXml& file, const std::string& attributes, std::size_t count,
              std::span<const double* const> components) {
  const std::size_t n = components.size();
  file.add_array(attributes, count, n * sizeof(Number), [&](std::size_t first, std::span<char> to) {
    auto* numbers = reinterpret_cast<Number*>(to.data());
    const std::size_t rows = to.size() / (n * sizeof(Number));
    for (std::size_t c = 0; c < n; ++c) {
      const double* from = components[c];
      for (std::size_t i = 0; i < rows; ++i)
        numbers[i * n + c] = from ? static_cast<Number>(from[first + i]) : Number{};
    }
  });
}

// An array of integers that are known by their index.
template <class Value>
void add_integers(VtkXml& file, std::string_view name, std::size_t count, Value&& value) {
  file.add_array("type=\"Int64\" " + attribute("Name", name), count, sizeof(std::int64_t),
                 [&](std::size_t first, std::span<char> to) {
                   auto* numbers = reinterpret_cast<std::int64_t*>(to.data());
                   for (std::size_t i = 0; i < to.size() / sizeof(std::int64_t); ++i)
                     numbers[i] = static_cast<std::int64_t>(value(first + i));
                 });
}

void add_field(VtkXml& file, std::size_t count, const OutputField& field) {
  const std::string name = attribute("Name", field.name);
  if (field.integers) return add_integers(file, field.name, count, [&](std::size_t i) { return field.integers[i]; });
  if (field.texts) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i) all.append(field.texts[i].c_str(), field.texts[i].size() + 1);
    return file.add_texts("type=\"String\" " + name, all);
  }
  const std::size_t n = field.components.size();
  std::string attributes = (field.single ? "type=\"Float32\" " : "type=\"Float64\" ") + name;
  if (n > 1) attributes += " NumberOfComponents=\"" + std::to_string(n) + "\"";
  if (n == 6) {
    int c = 0;
    for (const char* label : {"XX", "YY", "ZZ", "XY", "YZ", "XZ"})
      attributes += " ComponentName" + std::to_string(c++) + "=\"" + label + "\"";
  }
  if (field.single)
    add_rows<float>(file, attributes, count, field.components);
  else
    add_rows<double>(file, attributes, count, field.components);
}

void add_fields(VtkXml& file, const char* section, std::size_t count, std::span<const OutputField> fields) {
  file.add(std::string("<") + section + ">\n");
  for (const OutputField& field : fields) add_field(file, count, field);
  file.add(std::string("</") + section + ">\n");
}

void add_time(VtkXml& file, double time) {
  file.add("<FieldData>\n");
  file.add_array("type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"", 1, sizeof time,
                 [&](std::size_t, std::span<char> to) { std::memcpy(to.data(), &time, sizeof time); });
  file.add("</FieldData>\n");
}

// The cells of a file of points: of each kind the corners, and where each cell ends.
struct CellLists {
  enum Kind { verts, lines, polys };
  Kind kind = verts;
  std::size_t cells = 0, corners = 0;
  std::function<std::size_t(std::size_t)> corner, end;
};

// Every point is a cell. As long as their number is the same, so are the bytes of their lists.
void add_vertices(VtkXml& file, std::size_t count) {
  struct Packed {
    std::size_t count = 0;
    std::string corners, ends;
  };
  static thread_local Packed known;
  const bool same = count == known.count && count > 0;
  const auto add = [&](const char* name, std::string& packed, std::size_t first) {
    if (same) return file.add_packed("type=\"Int64\" " + attribute("Name", name), packed);
    add_integers(file, name, count, [&](std::size_t i) { return i + first; });
    packed = file.last_array();
  };
  known.count = 0;
  add("connectivity", known.corners, 0);
  add("offsets", known.ends, 1);
  known.count = count;
}

struct PolyData {
  std::size_t count;
  const std::array<const double*, 3>& position;
  std::span<const OutputField> point_fields, cell_fields;
  double time;
};

std::string file_of(const PolyData& data, const CellLists& cells) {
  check_numbers(data.count, data.position, data.point_fields);
  check_numbers(cells.cells, {}, data.cell_fields);
  VtkXml file("PolyData");
  file.add("<PolyData>\n");
  add_time(file, data.time);
  const auto number = [&](CellLists::Kind kind) { return std::to_string(cells.kind == kind ? cells.cells : 0); };
  file.add("<Piece NumberOfPoints=\"" + std::to_string(data.count) + "\" NumberOfVerts=\"" + number(CellLists::verts) +
           "\" NumberOfLines=\"" + number(CellLists::lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
           number(CellLists::polys) + "\">\n");
  add_fields(file, "PointData", data.count, data.point_fields);
  add_fields(file, "CellData", cells.cells, data.cell_fields);
  file.add("<Points>\n");
  add_rows<double>(file, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", data.count, data.position);
  file.add("</Points>\n");
  for (const auto& [kind, section] : {std::pair(CellLists::verts, "Verts"), std::pair(CellLists::lines, "Lines"),
                                      std::pair(CellLists::polys, "Polys")}) {
    if (kind != cells.kind) continue;
    file.add(std::string("<") + section + ">\n");
    if (kind == CellLists::verts) {
      add_vertices(file, cells.cells);
    } else {
      add_integers(file, "connectivity", cells.corners, cells.corner);
      add_integers(file, "offsets", cells.cells, cells.end);
    }
    file.add(std::string("</") + section + ">\n");
  }
  file.add("</Piece>\n");
  return file.finish();
}

template <class Content>
void write(const std::filesystem::path& path, Content&& content) {
  with_memory_for("the file '" + printable(path.string()) + "'", [&] { write_atomically(path, content()); });
}

}  // namespace

void check_numbers(std::size_t count, const std::array<const double*, 3>& position,
                   std::span<const OutputField> fields) {
  for (const double* x : position) check_component("position", x, count);
  for (const OutputField& field : fields)
    for (const double* values : field.components) check_component(field.name, values, count);
}

void write_surface(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                   std::span<const std::uint32_t> cells, std::size_t corners, std::span<const OutputField> fields,
                   double time) {
  CellLists lists{corners == 2 ? CellLists::lines : CellLists::polys, cells.size() / corners, cells.size(), {}, {}};
  lists.corner = [&](std::size_t k) { return cells[k]; };
  lists.end = [&](std::size_t k) { return (k + 1) * corners; };
  write(path, [&] { return file_of({count, position, fields, {}, time}, lists); });
}

void write_cells(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                 std::span<const std::uint32_t> cells, std::span<const std::size_t> ends,
                 std::span<const OutputField> fields, double time) {
  bool lines = true;
  for (std::size_t k = 0; k < ends.size(); ++k) lines = lines && ends[k] - (k > 0 ? ends[k - 1] : 0) <= 2;
  CellLists lists{lines ? CellLists::lines : CellLists::polys, ends.size(), ends.empty() ? 0 : ends.back(), {}, {}};
  lists.corner = [&](std::size_t k) { return cells[k]; };
  lists.end = [&](std::size_t k) { return ends[k]; };
  write(path, [&] { return file_of({count, position, {}, fields, time}, lists); });
}

void write_particles(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                     std::span<const OutputField> fields, double time) {
  write(path, [&] { return file_of({count, position, fields, {}, time}, {CellLists::verts, count, count, {}, {}}); });
}

void write_grid(const std::filesystem::path& path, const std::array<double, 3>& origin,
                const std::array<double, 3>& spacing, const std::array<int, 3>& nodes,
                std::span<const OutputField> fields, double time) {
  std::string extent, corner, step;
  std::size_t count = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const char* const blank = d > 0 ? " " : "";
    extent += std::string(blank) + "0 " + std::to_string(nodes[d] - 1);
    corner += blank + number_text(origin[d]), step += blank + number_text(spacing[d]);
    count *= static_cast<std::size_t>(nodes[d]);
  }
  write(path, [&] {
    check_numbers(count, {}, fields);
    VtkXml file("ImageData");
    file.add("<ImageData " + attribute("WholeExtent", extent) + " " + attribute("Origin", corner) + " " +
             attribute("Spacing", step) + " Direction=\"1 0 0 0 1 0 0 0 1\">\n");
    add_time(file, time);
    file.add("<Piece " + attribute("Extent", extent) + ">\n");
    add_fields(file, "PointData", count, fields);
    file.add("</Piece>\n");
    return file.finish();
  });
}

void Collection::resume(double time) {
  lines_.clear(), count_ = 0;
  for (const auto& e : read_collection(path_))
    if (e.time <= time) append(e.time, std::filesystem::relative(e.file, path_.parent_path()).string());
}

void Collection::append(double time, const std::string& file) {
  lines_ += "<DataSet timestep=\"" + number_text(time) + "\" part=\"0\" file=\"" + file + "\"/>\n", ++count_;
}

void Collection::add(double time, const std::string& file, OutputQueue* queue) {
  append(time, file);
  const std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n" +
      lines_ + "</Collection>\n</VTKFile>\n";
  if (!queue) return write_atomically(path_, text);
  queue->add_version(path_.string(), text.size(), [path = path_, text] { write_atomically(path, text); });
}

}  // namespace tribo
