// SPDX-License-Identifier: MIT
/// Reading of the files that vtk.cpp writes.

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/vtk_file.hpp"
#include "output/vtk.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// The files of results are points and cells.
class ResultFile : public VtkFile {
 public:
  explicit ResultFile(const std::filesystem::path& path) : VtkFile(path) {
    if (kind() != "PolyData") fail("it is not a file of points and cells");
  }
};

// Time and points.
template <class Frame>
Frame frame_of(const VtkFile& file) {
  Frame frame;
  const auto* time = file.find("FieldData", "TimeValue");
  if (!time) file.fail("it has no time");
  frame.time = file.numbers(*time, 1).front();
  if (!std::isfinite(frame.time)) file.fail("its time is not a finite number");
  const auto* points = file.find("Points", "Points");
  if (!points || file.components(*points) != 3) file.fail("it has no points");
  const auto x = file.numbers(*points, 3 * file.points());
  frame.position.resize(file.points());
  for (std::size_t i = 0; i < frame.position.size(); ++i)
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, frame.position[i].begin());
  return frame;
}

std::vector<ParticleFrame::Field> fields_of(const VtkFile& file, std::string_view section, std::size_t count) {
  std::vector<ParticleFrame::Field> out;
  for (const VtkFile::DataArray& array : file.arrays()) {
    if (array.section != section) continue;
    ParticleFrame::Field field;
    field.name = printable(VtkFile::word(array.words, "Name")), field.components = file.components(array);
    field.integers = VtkFile::word(array.words, "type").rfind("Float", 0) != 0;
    field.values = file.numbers(array, count * static_cast<std::size_t>(field.components));
    out.push_back(std::move(field));
  }
  return out;
}

// The domains are not a field to draw. Four numbers are two vectors in the plane, nine are three in space.
void take_domains(ParticleFrame& frame) {
  const auto found = std::find_if(frame.fields.begin(), frame.fields.end(), [](const auto& f) {
    return f.name == "domain" && (f.components == 4 || f.components == 9);
  });
  if (found == frame.fields.end()) return;
  const std::size_t dimension = found->components == 4 ? 2 : 3;
  frame.domains.assign(frame.count(), {});
  auto from = found->values.begin();
  for (HalfAxes& axes : frame.domains)
    for (std::size_t k = 0; k < dimension; ++k)
      for (std::size_t d = 0; d < dimension; ++d) axes[k][d] = *from++;
  frame.fields.erase(found);
}

// Adds the cells of a section: the numbers of their corners, and where each cell ends.
void take_cells(const VtkFile& file, std::string_view section, std::size_t count, CellFrame& frame) {
  if (count == 0) return;
  const auto *corners = file.find(section, "connectivity"), *offsets = file.find(section, "offsets");
  if (!corners || !offsets) file.fail("its cells are missing");
  const auto ends = file.numbers(*offsets, count);
  double last = 0;
  for (const double end : ends) {
    if (!(end >= last) || end > 1e12) file.fail("its cells do not follow each other");
    last = end;
  }
  const auto list = file.numbers(*corners, static_cast<std::size_t>(last));
  std::size_t at = 0;
  for (const double end : ends) {
    auto& cell = frame.cells.emplace_back();
    for (; at < static_cast<std::size_t>(end); ++at) {
      if (!(list[at] >= 0 && list[at] < static_cast<double>(frame.position.size())))
        file.fail("a cell has a corner that does not exist");
      cell.push_back(static_cast<std::uint32_t>(list[at]));
    }
  }
}

const ParticleFrame::Field* named(const std::vector<ParticleFrame::Field>& fields, std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace

const ParticleFrame::Field* ParticleFrame::field(std::string_view name) const { return named(fields, name); }
const ParticleFrame::Field* CellFrame::field(std::string_view name) const { return named(fields, name); }

namespace {

// Appends the particles of another block. All blocks of a file have the same fields.
void append(ParticleFrame& frame, const ParticleFrame& more, const std::filesystem::path& path) {
  const auto fail = [&] {
    throw FileError("the file '" + printable(path.string()) + "' is damaged: its blocks have different fields");
  };
  if (frame.fields.size() != more.fields.size() || frame.domains.empty() != more.domains.empty()) fail();
  for (std::size_t k = 0; k < frame.fields.size(); ++k) {
    auto& to = frame.fields[k];
    const auto& from = more.fields[k];
    if (to.name != from.name || to.components != from.components) fail();
    to.values.insert(to.values.end(), from.values.begin(), from.values.end());
  }
  frame.position.insert(frame.position.end(), more.position.begin(), more.position.end());
  frame.domains.insert(frame.domains.end(), more.domains.begin(), more.domains.end());
}

// Blocks without particles have no domains, and do not count.
ParticleFrame read_blocks_of_particles(const std::filesystem::path& path) {
  ParticleFrame frame;
  bool first = true;
  for (const BlockEntry& block : read_blocks(path)) {
    ParticleFrame next = read_particles(block.file);
    if (first || frame.count() == 0)
      frame = std::move(next);
    else if (next.count() > 0)
      append(frame, next, path);
    first = false;
  }
  return frame;
}

}  // namespace

ParticleFrame read_particles(const std::filesystem::path& path) {
  if (path.extension() == ".vtm") return read_blocks_of_particles(path);
  const ResultFile file(path);
  auto frame = frame_of<ParticleFrame>(file);
  frame.fields = fields_of(file, "PointData", frame.count());
  take_domains(frame);
  return frame;
}

CellFrame read_cells(const std::filesystem::path& path) {
  const ResultFile file(path);
  auto frame = frame_of<CellFrame>(file);
  for (const auto& [section, count] :
       {std::pair("Verts", "NumberOfVerts"), std::pair("Lines", "NumberOfLines"), std::pair("Polys", "NumberOfPolys")})
    take_cells(file, section, file.count_of(count), frame);
  frame.fields = fields_of(file, "CellData", frame.count());
  return frame;
}

}  // namespace tribo
