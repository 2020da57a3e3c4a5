// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "geometry/region.hpp"
#include "tests/geometry/counting.hpp"
#include "tests/scratch.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>

using namespace tribo;

namespace {

std::string little(std::uint32_t value, int bytes) {
  std::string out;
  for (int k = 0; k < bytes; ++k) out += k < 4 ? static_cast<char>(value >> (8 * k) & 0xFF) : '\0';
  return out;
}

// A BMP of 3 x 2 pixels: grey 10 20 30 above 40 50 60.
std::string bmp(int bits, bool top_down) {
  std::string pixels, palette;
  if (bits == 8)
    for (std::uint32_t k = 0; k < 256; ++k) palette += little(k | k << 8 | k << 16, 4);
  for (int row = 0; row < 2; ++row) {
    const int top = top_down ? row : 1 - row;
    std::string line;
    for (int column = 0; column < 3; ++column) {
      const auto grey = static_cast<std::uint32_t>(10 + 30 * top + 10 * column);
      line += little(bits == 8 ? grey : grey | grey << 8 | grey << 16, bits / 8);
    }
    line.resize((line.size() + 3) / 4 * 4, '\0');
    pixels += line;
  }
  const auto offset = static_cast<std::uint32_t>(54 + palette.size());
  return "BM" + little(static_cast<std::uint32_t>(offset + pixels.size()), 4) + little(0, 4) + little(offset, 4) +
         little(40, 4) + little(3, 4) + little(top_down ? 0xFFFFFFFEu : 2, 4) + little(1, 2) +
         little(static_cast<std::uint32_t>(bits), 2) + little(0, 24) + palette + pixels;
}

std::uint32_t checksum(const std::string& data) {
  std::uint32_t c = 0xFFFFFFFFu;
  for (const char byte : data) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xEDB88320u ^ c >> 1 : c >> 1;
  }
  return ~c;
}

std::string big(std::uint32_t value) {
  std::string out;
  for (int k = 3; k >= 0; --k) out += static_cast<char>(value >> (8 * k) & 0xFF);
  return out;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big(static_cast<std::uint32_t>(data.size())) + type + data + big(checksum(type + data));
}

// A PNG with stored (not compressed) rows; each row begins with its filter byte 0.
std::string png(int width, int height, int colour_type, const std::string& rows) {
  std::uint32_t a = 1, b = 0;
  for (const char byte : rows) a = (a + static_cast<unsigned char>(byte)) % 65521, b = (b + a) % 65521;
  const auto length = static_cast<std::uint32_t>(rows.size());
  const std::string zlib = "\x78\x01\x01" + little(length, 2) + little(~length & 0xFFFF, 2) + rows + big(b << 16 | a);
  return std::string("\x89PNG\r\n\x1A\n") +
         chunk("IHDR", big(static_cast<std::uint32_t>(width)) + big(static_cast<std::uint32_t>(height)) + '\x08' +
                           static_cast<char>(colour_type) + std::string(3, '\0')) +
         chunk("IDAT", zlib) + chunk("IEND", "");
}

std::string bytes(std::initializer_list<int> values) {
  std::string out;
  for (const int v : values) out += static_cast<char>(v);
  return out;
}

std::string grey_png() { return png(3, 2, 0, bytes({0, 10, 20, 30, 0, 40, 50, 60})); }

void check_pixels(const Image& image) {
  REQUIRE(image.width() == 3);
  REQUIRE(image.height() == 2);
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) CHECK(image.grey(column, row) == 10 + 30 * row + 10 * column);
}

}  // namespace

TEST_CASE("the pixels of BMP and PNG pictures are read from the top left", "[geometry][image]") {
  for (const int bits : {8, 24, 32})
    for (const bool top_down : {false, true}) {
      const ScratchFile file("grey.bmp", bmp(bits, top_down));
      check_pixels(Image(file.path));
    }
  const ScratchFile file("grey.png", grey_png());
  check_pixels(Image(file.path));
}

TEST_CASE("colours become grey by luma", "[geometry][image]") {
  const ScratchFile file("colours.png", png(3, 1, 2, bytes({0, 255, 0, 0, 0, 255, 0, 0, 0, 255})));
  const Image image(file.path);
  CHECK(image.grey(0, 0) == 76);
  CHECK(image.grey(1, 0) == 150);
  CHECK(image.grey(2, 0) == 29);
}

TEST_CASE("a picture selects the pixels in a range of grey, row 0 at ymax", "[geometry][image]") {
  const ScratchFile file("map.png", grey_png());
  const auto image = std::make_shared<const Image>(file.path);
  const auto dark = image_region(image, 0, 3, 0, 2, 10, 30);  // the upper row
  CHECK(dark->contains(Vec3(0.5, 1.5, 0)));
  CHECK(dark->contains(Vec3(2.5, 1.5, 7)));
  CHECK_FALSE(dark->contains(Vec3(0.5, 0.5, 0)));
  CHECK_FALSE(dark->contains(Vec3(3.5, 1.5, 0)));
  CHECK(*dark->measure() == Approx(3));
  const auto one = image_region(image, 0, 3, 0, 2, 50, 50);
  CHECK(one->contains(Vec3(1.5, 0.5, 0)));
  CHECK_FALSE(one->contains(Vec3(0.5, 0.5, 0)));
  CHECK_FALSE(one->contains(Vec3(2.5, 0.5, 0)));
  check_measure(*one, 2, 4, 0.01);
  CHECK(image_region(image, 0, 3, 0, 2, 60, 60)->contains(Vec3(3, 0, 0)));
}

TEST_CASE("a broken picture is a file error, never a crash", "[geometry][image]") {
  CHECK_THROWS_AS(Image("/nowhere/at/all.png"), FileError);
  CHECK_THROWS_AS(Image("/tmp"), FileError);
  const ScratchFile text("text.png", "hello");
  CHECK_THROWS_WITH(Image(text.path), Catch::Contains("neither a PNG nor a BMP"));
  auto one_bit = bmp(8, false);
  one_bit[28] = 1;
  const ScratchFile kind("kind.bmp", one_bit);
  CHECK_THROWS_WITH(Image(kind.path), Catch::Contains("valid: uncompressed with 8 (palette), 24 or 32 bits"));

  for (const auto& content : {bmp(8, false), bmp(24, false), bmp(32, true), grey_png()})
    for (std::size_t length = 0; length + 16 < content.size(); ++length) {
      const ScratchFile file("cut", content.substr(0, length));
      CHECK_THROWS_AS(Image(file.path), FileError);
    }
  std::mt19937 random(9);
  for (int n = 0; n < 1000; ++n) {
    auto content = n % 3 == 0 ? bmp(8, false) : (n % 3 == 1 ? bmp(24, true) : grey_png());
    for (int k = 0; k < 2; ++k)
      content[random() % std::min<std::size_t>(content.size(), 60)] = static_cast<char>(random());
    const ScratchFile file("flipped", content);
    try {
      const Image image(file.path);
    } catch (const FileError&) {
    }
  }
}
