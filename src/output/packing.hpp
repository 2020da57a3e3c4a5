// SPDX-License-Identifier: MIT
/// Compression in zlib's format, and check sums.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct libdeflate_compressor;

namespace tribo {

/// Compresses blocks of bytes where it pays, and stores them as they are in the same format where it does not: the
/// mantissas of computed numbers are as good as random. The result depends on the bytes only.
class Packer {
 public:
  /// Throws std::bad_alloc.
  Packer();
  /// Appends the packed block to `to`; returns its packed size.
  std::size_t append(std::string& to, std::string_view block);

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const;
  };
  using Compressor = std::unique_ptr<libdeflate_compressor, Free>;
  static Compressor compressor(int level);
  static std::size_t pack(libdeflate_compressor* level, std::string_view block, char* to, std::size_t most);
  bool pays(std::string_view block);

  Compressor packing_, storing_;
  std::string sample_;
};

/// CRC-32 of the bytes that `crc` stands for, 0 for none, and `bytes` after them.
std::uint32_t crc32(std::uint32_t crc, std::string_view bytes);

}  // namespace tribo
