// SPDX-License-Identifier: MIT
/// Messages between processes of the same program: numbers, one after the other.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace tribo {

/// Appends values to a message.
class ByteWriter {
 public:
  template <class T>
  void value(const T& x) {
    values(std::span<const T>(&x, 1));
  }
  /// Values without their number.
  template <class T>
  void values(std::span<const T> all) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::byte*>(all.data());
    data.insert(data.end(), from, from + all.size_bytes());
  }
  /// Values after their number.
  template <class T>
  void list(const std::vector<T>& all) {
    value(all.size());
    values(std::span<const T>(all));
  }

  std::vector<std::byte> data;
};

/// Reads the values of a message in the order in which they were written. Throws std::logic_error at its end.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> data) : rest_(data) {}

  template <class T>
  T value() {
    T x;
    values(std::span<T>(&x, 1));
    return x;
  }
  template <class T>
  void values(std::span<T> all) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (all.size_bytes() > rest_.size()) throw std::logic_error("a message between processes is too short");
    if (!all.empty()) std::memcpy(all.data(), rest_.data(), all.size_bytes());
    rest_ = rest_.subspan(all.size_bytes());
  }
  template <class T>
  std::vector<T> list() {
    std::vector<T> all(value<std::size_t>());
    values(std::span<T>(all));
    return all;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
};

}  // namespace tribo
