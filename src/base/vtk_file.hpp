// SPDX-License-Identifier: MIT
/// XML files of VTK with points: .vtp and .vtu. VTK's own reader trusts the sizes and offsets of a file, and a damaged
/// file can end the program. Here each of them is checked before it is used.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

class VtkFile {
 public:
  using Words = std::map<std::string, std::string, std::less<>>;

  /// An array: the section it stands in, such as PointData, its attributes, and its text if the data stand in it.
  struct DataArray {
    std::string section;
    Words words;
    std::string_view content{};
  };

  /// Reads a file. Throws FileError if its head is not one of such a file.
  explicit VtkFile(const std::filesystem::path& path);
  VtkFile(const VtkFile&) = delete;
  VtkFile& operator=(const VtkFile&) = delete;

  [[noreturn]] void fail(const std::string& why) const;

  /// PolyData, UnstructuredGrid, ...
  const std::string& kind() const { return kind_; }
  const std::vector<DataArray>& arrays() const { return arrays_; }
  std::size_t points() const { return count_of("NumberOfPoints"); }
  /// An attribute of the piece that is a number; 0 if there is none.
  std::size_t count_of(std::string_view what) const { return whole(piece_, what, 0); }

  /// An array of a section by its name, or null.
  const DataArray* find(std::string_view section, std::string_view name) const;
  /// The first array of a section, or null.
  const DataArray* first(std::string_view section) const;
  int components(const DataArray& array) const;
  /// The numbers of an array, of which there must be `count`.
  std::vector<double> numbers(const DataArray& array, std::size_t count) const;

  /// An attribute, or nothing.
  static std::string word(const Words& words, std::string_view name);

 private:
  void read_tags(std::string_view head);
  void read_head(const Words& all);
  Words words_of_tag(std::string_view tag) const;
  std::size_t whole(const Words& words, std::string_view name, std::size_t fallback) const;
  std::string bytes(const DataArray& array, std::size_t wanted) const;
  std::vector<double> written_numbers(const DataArray& array, std::size_t count) const;
  template <class T>
  std::vector<double> as(const DataArray& array, std::size_t count) const;

  std::string name_, text_, kind_;
  std::string_view appended_;      ///< the data behind the arrays
  bool appended_as_text_ = false;  ///< in base 64
  bool compressed_ = false;
  std::size_t header_ = 4;  ///< bytes of a number in the head of data
  Words piece_;
  std::vector<DataArray> arrays_;
};

}  // namespace tribo
