// SPDX-License-Identifier: MIT
#include "geometry/file.hpp"

#include "base/read_file.hpp"

namespace tribo {

Bytes::Bytes(const std::string& path) : path_(printable(path)), data_(read_file(path)) {}

std::uint8_t Bytes::byte(std::size_t offset) const {
  if (offset >= data_.size()) fail("the file is cut off");
  return static_cast<std::uint8_t>(data_[offset]);
}

std::uint16_t Bytes::half(std::size_t offset) const {
  return static_cast<std::uint16_t>(byte(offset) | byte(offset + 1) << 8);
}

std::uint32_t Bytes::word(std::size_t offset) const {
  return half(offset) | static_cast<std::uint32_t>(half(offset + 2)) << 16;
}

}  // namespace tribo
