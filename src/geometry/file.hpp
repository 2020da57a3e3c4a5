// SPDX-License-Identifier: MIT
/// A file read into memory, with checked access.
#pragma once

#include "base/error.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace tribo {

class Bytes {
 public:
  /// Throws FileError if the file cannot be read.
  explicit Bytes(const std::string& path);

  std::size_t size() const { return data_.size(); }
  std::string_view text() const { return data_; }
  /// Little-endian numbers at an offset; throw FileError beyond the end.
  std::uint8_t byte(std::size_t offset) const;
  std::uint16_t half(std::size_t offset) const;
  std::uint32_t word(std::size_t offset) const;
  /// Throws FileError `path: message`.
  [[noreturn]] void fail(const std::string& message) const { throw FileError(path_ + ": " + message); }
  /// Throws FileError `path:line:column: message`.
  [[noreturn]] void fail_at(int line, int column, const std::string& message) const {
    throw FileError(path_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + message);
  }

 private:
  std::string path_, data_;
};

}  // namespace tribo
