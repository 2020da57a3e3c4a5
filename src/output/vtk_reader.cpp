// SPDX-License-Identifier: MIT
/// Reading of the files that vtk.cpp writes. Every size and offset is checked before it is used, since files may be
/// damaged and VTK's own reader trusts them.

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/schema.hpp"
#include "output/vtk.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace tribo {
namespace {

using Words = std::map<std::string, std::string, std::less<>>;

/// An array of the file: where it stands, what it holds, where its numbers begin.
struct DataArray {
  std::string section;
  Words words;
};

/// The parts of a .vtp file with appended, compressed data.
class VtkFile {
 public:
  explicit VtkFile(const std::filesystem::path& path) : name_(printable(path.string())), text_(read_file(path)) {
    const auto appended = text_.find("<AppendedData"), begin = text_.find('_', appended);
    if (appended == std::string::npos || begin == std::string::npos) fail("its data are missing");
    data_ = std::string_view(text_).substr(begin + 1);
    tags(std::string_view(text_).substr(0, appended));
    if (kind_ != "PolyData") fail("it is not a file of points and cells");
    if (header_ != 4 && header_ != 8) fail("its head is not one that Tribo writes");
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw FileError("the file '" + name_ + "' is damaged: " + why);
  }

  const std::vector<DataArray>& arrays() const { return arrays_; }
  std::size_t points() const { return count_of("NumberOfPoints"); }
  std::size_t count_of(const char* what) const { return whole(piece_, what, 0); }

  const DataArray* find(std::string_view section, std::string_view name) const {
    for (const DataArray& a : arrays_)
      if (a.section == section && word(a.words, "Name") == name) return &a;
    return nullptr;
  }
  int components(const DataArray& array) const {
    const auto n = whole(array.words, "NumberOfComponents", 1);
    if (n < 1 || n > 64) fail("an array has " + std::to_string(n) + " components");
    return static_cast<int>(n);
  }
  static std::string word(const Words& words, std::string_view name) {
    const auto found = words.find(name);
    return found == words.end() ? std::string() : found->second;
  }

  /// The numbers of an array, of which there must be `count`.
  std::vector<double> numbers(const DataArray& array, std::size_t count) const {
    const std::string type = word(array.words, "type");
    if (type == "Float64") return as<double>(array, count);
    if (type == "Float32") return as<float>(array, count);
    if (type == "Int64") return as<std::int64_t>(array, count);
    if (type == "Int32") return as<std::int32_t>(array, count);
    if (type == "UInt8") return as<std::uint8_t>(array, count);
    fail("an array has the unknown type '" + printable(type) + "'");
  }

 private:
  // Tags of the head; an array belongs to the section around it.
  void tags(std::string_view head) {
    std::string section;
    for (std::size_t at = head.find('<'); at != std::string_view::npos; at = head.find('<', at + 1)) {
      const auto end = head.find('>', at);
      if (end == std::string_view::npos) fail("its head is cut off");
      const std::string_view tag = head.substr(at + 1, end - at - 1);
      const std::string name(tag.substr(0, tag.find_first_of(" \t\r\n/")));
      if (name.empty() || name[0] == '?') continue;
      if (name == "VTKFile") {
        const Words all = words(tag);
        kind_ = word(all, "type");
        header_ = word(all, "header_type") == "UInt32" ? 4 : word(all, "header_type") == "UInt64" ? 8 : 0;
        if (word(all, "compressor") != "vtkZLibDataCompressor" || word(all, "byte_order") != "LittleEndian")
          fail("its head is not one that Tribo writes");
      } else if (name == "Piece") {
        if (!piece_.empty()) fail("it has several pieces");
        piece_ = words(tag);
      } else if (name == "Array" || name == "InformationKey") {
        // texts, and the unit of an array
      } else if (name == "DataArray") {
        arrays_.push_back({section, words(tag)});
      } else {
        section = name;
      }
    }
  }

  // name="value" pairs
  Words words(std::string_view tag) const {
    Words out;
    for (auto equals = tag.find("=\""); equals != std::string_view::npos;) {
      const auto end = tag.find('"', equals + 2);
      if (end == std::string_view::npos) fail("its head is cut off");
      auto name = tag.substr(0, equals);
      name = name.substr(name.find_last_of(" \t\r\n") + 1);
      out[std::string(name)] = std::string(tag.substr(equals + 2, end - equals - 2));
      tag = tag.substr(end + 1);
      equals = tag.find("=\"");
    }
    return out;
  }

  std::size_t whole(const Words& words, std::string_view name, std::size_t fallback) const {
    const auto found = words.find(name);
    if (found == words.end()) return fallback;
    const auto value = to_number(found->second);
    if (!value || *value < 0 || *value > 1e15 || *value != std::trunc(*value))
      fail("'" + std::string(name) + "' is '" + printable(found->second) + "'");
    return static_cast<std::size_t>(*value);
  }

  // A number of the head of a block of data
  std::size_t header_word(std::size_t at) const {
    if (at > data_.size() || data_.size() - at < header_) fail("its data are cut off");
    std::uint64_t value = 0;
    std::memcpy(&value, data_.data() + at, header_);
    return static_cast<std::size_t>(value);
  }

  // Number of blocks, size of a block, size of the last one if it is smaller, compressed sizes, blocks.
  std::string bytes(const DataArray& array, std::size_t wanted) const {
    if (word(array.words, "format") != "appended") fail("an array is not among the appended data");
    const std::string name = "the array '" + printable(word(array.words, "Name")) + "'";
    std::size_t at = whole(array.words, "offset", 0);
    const std::size_t blocks = header_word(at);
    if (blocks == 0 && wanted == 0) return {};
    const std::size_t size = header_word(at + header_), partial = header_word(at + 2 * header_);
    if (blocks == 0 || blocks > data_.size() / header_ || size == 0 || size > wanted + (std::size_t{1} << 24) ||
        blocks - 1 > wanted / size || partial >= size || (blocks - 1) * size + (partial > 0 ? partial : size) != wanted)
      fail(name + " has another size than the file says");
    // zlib cannot make data smaller than by a factor of about a thousand.
    if (wanted / 1100 > data_.size()) fail(name + " is cut off");
    std::string out(wanted, '\0');
    std::size_t from = at + (3 + blocks) * header_, to = 0;
    for (std::size_t k = 0; k < blocks; ++k) {
      const std::size_t packed = header_word(at + (3 + k) * header_);
      const std::size_t plain = k + 1 == blocks && partial > 0 ? partial : size;
      if (from > data_.size() || packed > data_.size() - from) fail(name + " is cut off");
      auto unpacked = static_cast<uLongf>(plain);
      if (::uncompress(reinterpret_cast<Bytef*>(out.data() + to), &unpacked,
                       reinterpret_cast<const Bytef*>(data_.data() + from), static_cast<uLong>(packed)) != Z_OK ||
          unpacked != plain)
        fail(name + " cannot be unpacked");
      from += packed, to += plain;
    }
    return out;
  }

  template <class T>
  std::vector<double> as(const DataArray& array, std::size_t count) const {
    if (count > std::size_t{1} << 40) fail("it claims " + std::to_string(count) + " numbers");
    const std::string raw = bytes(array, count * sizeof(T));
    std::vector<double> out(count);
    for (std::size_t k = 0; k < count; ++k) {
      T value;
      std::memcpy(&value, raw.data() + k * sizeof(T), sizeof(T));
      out[k] = static_cast<double>(value);
    }
    return out;
  }

  std::string name_, text_, kind_;
  std::string_view data_;
  std::size_t header_ = 0;
  Words piece_;
  std::vector<DataArray> arrays_;
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
  for (const DataArray& array : file.arrays()) {
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
  const VtkFile file(path);
  auto frame = frame_of<ParticleFrame>(file);
  frame.fields = fields_of(file, "PointData", frame.count());
  take_domains(frame);
  return frame;
}

CellFrame read_cells(const std::filesystem::path& path) {
  const VtkFile file(path);
  auto frame = frame_of<CellFrame>(file);
  for (const auto& [section, count] :
       {std::pair("Verts", "NumberOfVerts"), std::pair("Lines", "NumberOfLines"), std::pair("Polys", "NumberOfPolys")})
    take_cells(file, section, file.count_of(count), frame);
  frame.fields = fields_of(file, "CellData", frame.count());
  return frame;
}

}  // namespace tribo
