// SPDX-License-Identifier: MIT
#include "output/packing.hpp"

#include <libdeflate.h>

#include <new>
#include <stdexcept>

namespace tribo {
namespace {

constexpr std::size_t sample_size = 8192;
constexpr double worthwhile = 0.85;  // of the size

}  // namespace

void Packer::Free::operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }

Packer::Compressor Packer::compressor(int level) {
  Compressor out(libdeflate_alloc_compressor(level));
  if (!out) throw std::bad_alloc();
  return out;
}

Packer::Packer() : packing_(compressor(1)), storing_(compressor(0)) {}

std::size_t Packer::append(std::string& to, std::string_view block) {
  auto* const level = pays(block) ? packing_.get() : storing_.get();
  const std::size_t before = to.size(), most = libdeflate_zlib_compress_bound(level, block.size());
  to.resize(before + most);
  const std::size_t size = pack(level, block, to.data() + before, most);
  to.resize(before + size);
  return size;
}

std::size_t Packer::pack(libdeflate_compressor* level, std::string_view block, char* to, std::size_t most) {
  const std::size_t size = libdeflate_zlib_compress(level, block.data(), block.size(), to, most);
  if (size == 0) throw std::logic_error("a block of data did not fit into its bound");
  return size;
}

// By the size of a part in the middle.
bool Packer::pays(std::string_view block) {
  if (block.size() < 2 * sample_size) return true;
  const auto part = block.substr((block.size() - sample_size) / 2 / sizeof(double) * sizeof(double), sample_size);
  sample_.resize(libdeflate_zlib_compress_bound(packing_.get(), part.size()));
  const std::size_t size = pack(packing_.get(), part, sample_.data(), sample_.size());
  return static_cast<double>(size) < worthwhile * static_cast<double>(part.size());
}

std::uint32_t crc32(std::uint32_t crc, std::string_view bytes) {
  return libdeflate_crc32(crc, bytes.data(), bytes.size());
}

}  // namespace tribo
