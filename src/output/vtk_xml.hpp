// SPDX-License-Identifier: MIT
/// The text of VTK's XML files: a head of tags, and arrays of numbers after it in blocks compressed by zlib's format.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace tribo {

/// A file for ParaView that is put together in memory. Its bytes depend on the contents only.
class VtkXml {
 public:
  /// `kind`: the data set, such as PolyData.
  explicit VtkXml(std::string_view kind);

  /// Text of the head, as it is.
  void add(std::string_view text) { head_ += text; }
  /// An array of `rows` of `row_bytes` each, at least 1 and at most 64 KiB, with these attributes of its tag.
  /// `fill(first, to)` writes the rows from `first` on until `to` is full.
  using Fill = std::function<void(std::size_t first, std::span<char> to)>;
  void add_array(std::string_view attributes, std::size_t rows, std::size_t row_bytes, const Fill& fill);
  /// Texts, each of which ends with a zero.
  void add_texts(std::string_view attributes, std::string_view texts);
  /// An array again: what last_array() returned after it was added to a file.
  void add_packed(std::string_view attributes, std::string_view packed);
  /// The appended data of the array that was added last.
  std::string_view last_array() const { return std::string_view(data_).substr(last_); }

  /// The complete file.
  std::string finish();

 private:
  void tag(std::string_view name, std::string_view attributes);
  void append_rows(std::size_t rows, std::size_t row_bytes, const Fill& fill);

  std::string kind_, head_, data_;
  std::size_t last_ = 0;
};

/// A name as the value of an attribute.
std::string attribute(std::string_view name, std::string_view value);

}  // namespace tribo
