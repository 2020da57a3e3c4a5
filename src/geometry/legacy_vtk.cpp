// SPDX-License-Identifier: MIT
/// The older format of VTK: lines with keywords, and numbers as text or as bytes, the highest first. Every count is
/// checked against the size of the file before it is used.
#include "base/read_file.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "geometry/file.hpp"
#include "geometry/point_file.hpp"

#include <algorithm>
#include <cstring>
#include <map>

namespace tribo {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Bytes of a number of a type, and how to read it.
struct NumberType {
  std::size_t size;
  double (*value)(std::uint64_t bits);
};

template <class T, class Bits>
double as(std::uint64_t bits) {
  const auto own = static_cast<Bits>(bits);
  T value;
  static_assert(sizeof value == sizeof own);
  std::memcpy(&value, &own, sizeof value);
  return static_cast<double>(value);
}

const std::map<std::string, NumberType>& number_types() {
  static const std::map<std::string, NumberType> all{{"float", {4, as<float, std::uint32_t>}},
                                                     {"double", {8, as<double, std::uint64_t>}},
                                                     {"int", {4, as<std::int32_t, std::uint32_t>}},
                                                     {"unsigned_int", {4, as<std::uint32_t, std::uint32_t>}},
                                                     {"vtkidtype", {4, as<std::int32_t, std::uint32_t>}},
                                                     {"long", {8, as<std::int64_t, std::uint64_t>}},
                                                     {"unsigned_long", {8, as<std::uint64_t, std::uint64_t>}},
                                                     {"vtktypeint64", {8, as<std::int64_t, std::uint64_t>}},
                                                     {"vtktypeuint64", {8, as<std::uint64_t, std::uint64_t>}},
                                                     {"short", {2, as<std::int16_t, std::uint16_t>}},
                                                     {"unsigned_short", {2, as<std::uint16_t, std::uint16_t>}},
                                                     {"char", {1, as<std::int8_t, std::uint8_t>}},
                                                     {"unsigned_char", {1, as<std::uint8_t, std::uint8_t>}}};
  return all;
}

class LegacyFile {
 public:
  explicit LegacyFile(const std::string& path) : bytes_(path), text_(bytes_.text()) {
    const std::string_view head = "# vtk DataFile Version ";
    if (text_.substr(0, head.size()) != head)
      bytes_.fail("this is not a file of VTK: it does not begin with '# vtk DataFile Version'");
    offsets_ = to_number(raw_line().substr(head.size())).value_or(0) >= 5;
    raw_line();  // the title
    const std::string form = lower(line().at(0));
    if (form != "ascii" && form != "binary") fail("it is neither ASCII nor BINARY, but '" + form.substr(0, 40) + "'");
    binary_ = form == "binary";
  }

  PointFile read() {
    while (true) {
      while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
      if (at_ == text_.size()) break;
      words_ = line();
      section();
    }
    if (out_.position.empty()) bytes_.fail("no points were found; this is not a complete file of VTK with points");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    const auto before = text_.substr(0, line_begin_);
    bytes_.fail_at(
        1 + static_cast<int>(std::min<std::ptrdiff_t>(std::count(before.begin(), before.end(), '\n'), 999'999'999)), 1,
        why);
  }

  // The next line, which may be empty.
  std::string_view raw_line() {
    line_begin_ = at_;
    const auto end = std::min(text_.find('\n', at_), text_.size());
    std::string_view out = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
    return out;
  }
  // The words of the next line that has any.
  std::vector<std::string> line() {
    while (at_ < text_.size()) {
      const std::string_view next = raw_line();
      if (next.size() > 10'000) fail("a line with keywords is too long");
      if (auto words = words_of(next); !words.empty()) return words;
    }
    fail("the file is cut off");
  }
  const std::string& word(std::size_t k) const {
    if (k >= words_.size()) fail("'" + words_.at(0).substr(0, 40) + "' needs more words");
    return words_[k];
  }
  std::size_t count(std::size_t k) const {
    const auto value = to_number(word(k));
    if (!value || !(*value >= 0) || *value > 1e12 || *value != static_cast<double>(static_cast<std::size_t>(*value)))
      fail("'" + word(k).substr(0, 40) + "' is not a number of values");
    return static_cast<std::size_t>(*value);
  }

  std::vector<double> numbers(const std::string& type, std::size_t wanted) {
    const auto found = number_types().find(lower(type));
    if (found == number_types().end()) fail("numbers of the type '" + type.substr(0, 40) + "' are not read");
    std::vector<double> out;
    if (binary_) {
      const auto [size, value] = found->second;
      if (wanted > (text_.size() - at_) / size) fail("the file is cut off");
      out.reserve(wanted);
      for (std::size_t k = 0; k < wanted; ++k) {
        std::uint64_t bits = 0;
        for (std::size_t b = 0; b < size; ++b) bits = bits << 8U | static_cast<unsigned char>(text_[at_++]);
        out.push_back(value(bits));
      }
      return out;
    }
    if (wanted > text_.size() - at_) fail("the file is cut off");
    out.reserve(wanted);
    while (out.size() < wanted) {
      while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
      line_begin_ = at_;
      std::size_t end = at_;
      while (end < text_.size() && !is_blank(text_[end])) ++end;
      if (end == at_) fail("the file is cut off");
      const auto value = to_number(text_.substr(at_, end - at_));
      if (!value)
        fail("'" + std::string(text_.substr(at_, std::min<std::size_t>(end - at_, 40))) + "' is not a number");
      out.push_back(*value);
      at_ = end;
    }
    return out;
  }

  void add(const std::string& name, std::size_t components, std::vector<double> values) {
    if (of_points_) out_.arrays.push_back({printable(name), components, std::move(values)});
  }

  // One component or several for each point or cell
  void attribute(std::size_t components, const std::string& type) {
    if (!of_points_ && !of_cells_) fail("'" + words_[0] + "' stands before POINT_DATA or CELL_DATA");
    if (components < 1 || components > 64) fail("an array has " + std::to_string(components) + " components");
    const std::string name = word(1);
    add(name, components, numbers(type, components * values_));
  }

  void cells() {
    const std::size_t first = count(1), second = count(2);
    if (!offsets_) {
      numbers("int", second);
      return;
    }
    for (const std::size_t n : {first, second}) {
      words_ = line();  // OFFSETS, CONNECTIVITY
      numbers(word(1), n);
    }
  }

  void fields() {
    const std::size_t number = count(2);
    for (std::size_t k = 0; k < number; ++k) {
      words_ = line();
      if (words_[0] == "METADATA") {
        metadata();
        words_ = line();
      }
      const std::string name = word(0);
      const std::size_t components = count(1), tuples = count(2);
      if (components < 1 || components > 64) fail("an array has " + std::to_string(components) + " components");
      auto values = numbers(word(3), components * tuples);
      if (of_points_ && tuples == values_) add(name, components, std::move(values));
    }
  }

  // Lines up to an empty one
  void metadata() {
    while (at_ < text_.size() && !words_of(raw_line()).empty()) {
    }
  }

  void section() {
    const std::string key = lower(words_[0]);
    if (key == "dataset") {
      const std::string kind = lower(word(1));
      if (kind != "polydata" && kind != "unstructured_grid" && kind != "structured_grid")
        fail("'" + word(1).substr(0, 40) + "' has no points; POLYDATA, UNSTRUCTURED_GRID and STRUCTURED_GRID have");
    } else if (key == "points") {
      const std::size_t n = count(1);
      const auto x = numbers(word(2), 3 * n);
      out_.position.resize(n);
      for (std::size_t i = 0; i < n; ++i) out_.position[i] = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    } else if (key == "vertices" || key == "lines" || key == "polygons" || key == "triangle_strips" || key == "cells") {
      cells();
    } else if (key == "cell_types") {
      numbers("int", count(1));
    } else if (key == "point_data" || key == "cell_data") {
      of_points_ = key == "point_data", of_cells_ = !of_points_, values_ = count(1);
      if (of_points_ && values_ != out_.position.size())
        fail("there are " + word(1) + " values, but " + std::to_string(out_.position.size()) + " points");
    } else if (key == "scalars") {
      scalars();
    } else if (key == "lookup_table") {
      numbers(binary_ ? "unsigned_char" : "float", 4 * count(2));
    } else if (key == "color_scalars") {
      numbers(binary_ ? "unsigned_char" : "float", count(2) * values_);
    } else if (key == "vectors" || key == "normals") {
      attribute(3, word(2));
    } else if (key == "tensors") {
      attribute(9, word(2));
    } else if (key == "tensors6") {
      attribute(6, word(2));
    } else if (key == "global_ids" || key == "pedigree_ids") {
      attribute(1, word(2));
    } else if (key == "texture_coordinates") {
      attribute(count(2), word(3));
    } else if (key == "field") {
      fields();
    } else if (key == "metadata") {
      metadata();
    } else if (key != "dimensions") {
      fail("the keyword '" + words_[0].substr(0, 40) + "' is not known");
    }
  }

  void scalars() {
    const std::string type = word(2);
    const std::size_t components = words_.size() > 3 ? count(3) : 1;
    const std::size_t before = at_;
    if (lower(line()[0]) != "lookup_table") at_ = before;  // it may be left out
    attribute(components, type);
  }

  Bytes bytes_;
  std::string_view text_;
  std::size_t at_ = 0, line_begin_ = 0;
  bool binary_ = false;
  bool offsets_ = false;  ///< cells are given by offsets, since version 5
  std::vector<std::string> words_;
  bool of_points_ = false, of_cells_ = false;
  std::size_t values_ = 0;  ///< number of points or cells of the section
  PointFile out_;
};

}  // namespace

PointFile read_legacy_point_file(const std::string& path) { return LegacyFile(path).read(); }

}  // namespace tribo
