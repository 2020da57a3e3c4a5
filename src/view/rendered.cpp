// SPDX-License-Identifier: MIT
/// Marks in pictures and films by which `tribo render` knows its own.

#include "base/error.hpp"
#include "view/picture.hpp"

#include <zlib.h>

#include <fstream>

namespace tribo {
namespace {

constexpr std::size_t head_of_png = 33;  // signature and IHDR

// A number as PNG and MP4 store it.
std::string big_endian(std::uint32_t number) {
  std::string out;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>((number >> shift) & 0xFFU);
  return out;
}

std::string png_mark() {
  const std::string text = std::string("tEXtSoftware") + '\0' + "tribo render";
  const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  return big_endian(static_cast<std::uint32_t>(text.size() - 4)) + text + big_endian(static_cast<std::uint32_t>(crc));
}

}  // namespace

std::string film_mark() {
  const std::string content = "free" + std::string("made by tribo render");
  return big_endian(static_cast<std::uint32_t>(content.size() + 4)) + content;
}

std::string marked_as_rendered(const std::string& png) {
  if (png.size() < head_of_png) throw FileError("the picture could not be drawn");
  return std::string(png).insert(head_of_png, png_mark());
}

bool is_rendered(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file))) return false;
  std::ifstream in(file, std::ios::binary);
  const auto holds = [&](std::streamoff from, std::ios::seekdir begin, const std::string& mark) {
    std::string found(mark.size(), '\0');
    in.clear();
    in.seekg(from, begin);
    return in.read(found.data(), static_cast<std::streamsize>(found.size())) && found == mark;
  };
  return holds(head_of_png, std::ios::beg, png_mark()) ||
         holds(-static_cast<std::streamoff>(film_mark().size()), std::ios::end, film_mark());
}

}  // namespace tribo
