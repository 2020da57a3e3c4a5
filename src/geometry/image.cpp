// SPDX-License-Identifier: MIT
#include "geometry/file.hpp"
#include "geometry/interval.hpp"
#include "geometry/region.hpp"

#include <png.h>

#include <cstdlib>
#include <limits>

namespace tribo {
namespace {

constexpr std::int64_t most_pixels = 1 << 28;

// ITU-R BT.601, rounded.
unsigned char luma(int red, int green, int blue) {
  return static_cast<unsigned char>((299 * red + 587 * green + 114 * blue + 500) / 1000);
}

struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> grey;
};

Picture read_png(const Bytes& bytes) {
  struct Guard {
    png_image image{};
    ~Guard() { png_image_free(&image); }
  } guard;
  png_image& image = guard.image;
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.text().data(), bytes.size()))
    bytes.fail(std::string("the PNG cannot be read: ") + image.message);
  if (static_cast<std::int64_t>(image.width) * image.height > most_pixels) bytes.fail("the picture is too large");
  image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> colours(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&image, &white, colours.data(), 0, nullptr))
    bytes.fail(std::string("the PNG cannot be read: ") + image.message);
  Picture out{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  out.grey.resize(colours.size() / 3);
  for (std::size_t k = 0; k < out.grey.size(); ++k)
    out.grey[k] = luma(colours[3 * k], colours[3 * k + 1], colours[3 * k + 2]);
  return out;
}

// Format: file header of 14 bytes, information header (40 bytes or more), palette, then the rows from bottom to top,
// each padded to a multiple of 4 bytes. A negative height means rows from top to bottom.
Picture read_bmp(const Bytes& bytes) {
  const std::size_t pixels = bytes.word(10), information = bytes.word(14);
  if (information < 40) bytes.fail("this kind of BMP (OS/2) is not supported");
  const auto width = static_cast<std::int32_t>(bytes.word(18)), rows = static_cast<std::int32_t>(bytes.word(22));
  const int bits = bytes.half(28);
  const auto compression = bytes.word(30);
  const std::int64_t height = std::abs(static_cast<std::int64_t>(rows));
  if (width <= 0 || height == 0) bytes.fail("the picture has no pixels");
  if (width * height > most_pixels) bytes.fail("the picture is too large");
  const bool plain_masks = compression == 3 && bits == 32 && bytes.word(54) == 0x00FF0000u &&
                           bytes.word(58) == 0x0000FF00u && bytes.word(62) == 0x000000FFu;
  if ((bits != 8 && bits != 24 && bits != 32) || (compression != 0 && !plain_masks))
    bytes.fail(
        "this kind of BMP is not supported; valid: uncompressed with 8 (palette), 24 or 32 bits per pixel, not " +
        std::to_string(bits) + (compression == 0 ? "" : " compressed"));

  const std::size_t used = bits != 8 ? 0 : (bytes.word(46) == 0 ? 256 : bytes.word(46)), palette = 14 + information;
  const std::size_t deep = static_cast<std::size_t>(bits) / 8;
  const std::size_t columns = static_cast<std::size_t>(width), stride = (columns * deep + 3) / 4 * 4;
  const std::size_t total = static_cast<std::size_t>(height);
  if (bytes.size() < pixels || bytes.size() - pixels < stride * (total - 1) + columns * deep)
    bytes.fail("the file is cut off");
  Picture out{width, static_cast<int>(height), std::vector<unsigned char>(columns * total)};
  for (std::size_t row = 0; row < total; ++row) {
    const std::size_t from = pixels + stride * (rows > 0 ? total - 1 - row : row);
    for (std::size_t column = 0; column < columns; ++column) {
      std::size_t at = from + deep * column;
      if (bits == 8) {
        if (bytes.byte(at) >= used) bytes.fail("a pixel has a colour that is not in the palette");
        at = palette + 4 * std::size_t{bytes.byte(at)};
      }
      out.grey[row * columns + column] = luma(bytes.byte(at + 2), bytes.byte(at + 1), bytes.byte(at));
    }
  }
  return out;
}

Picture read(const std::string& path) {
  const Bytes bytes(path);
  if (bytes.text().starts_with("\x89PNG\r\n\x1A\n")) return read_png(bytes);
  if (bytes.text().starts_with("BM")) return read_bmp(bytes);
  bytes.fail("this is neither a PNG nor a BMP picture");
}

class ImageRegion final : public Region {
 public:
  ImageRegion(std::shared_ptr<const Image> image, Interval x, Interval y, int low, int high)
      : image_(std::move(image)), x_(x), y_(y), low_(low), high_(high) {}

  bool contains(const Vec3& p) const override {
    if (!x_.contains(p[0]) || !y_.contains(p[1])) return false;
    return chosen(pixel((p[0] - x_.low()) / x_.length(), image_->width()),
                  pixel((y_.high() - p[1]) / y_.length(), image_->height()));
  }
  Bounds bounds() const override { return flat_bounds(x_, y_); }
  std::optional<double> measure() const override {
    double count = 0.0;
    for (int row = 0; row < image_->height(); ++row)
      for (int column = 0; column < image_->width(); ++column) count += chosen(column, row) ? 1.0 : 0.0;
    return count * (x_.length() / image_->width()) * (y_.length() / image_->height());
  }

 private:
  static int pixel(double fraction, int count) {
    return std::clamp(static_cast<int>(std::floor(fraction * count)), 0, count - 1);
  }
  bool chosen(int column, int row) const {
    const int grey = image_->grey(column, row);
    return grey >= low_ && grey <= high_;
  }

  std::shared_ptr<const Image> image_;
  Interval x_, y_;
  int low_, high_;
};

}  // namespace

Image::Image(const std::string& path) {
  auto picture = read(path);
  width_ = picture.width, height_ = picture.height, grey_ = std::move(picture.grey);
}

RegionPtr image_region(std::shared_ptr<const Image> image, double xmin, double xmax, double ymin, double ymax, int low,
                       int high) {
  require_finite("the picture's rectangle", xmin, xmax, ymin, ymax);
  const Interval x(xmin, xmax), y(ymin, ymax);
  if (x.length() <= 0.0 || y.length() <= 0.0) throw std::runtime_error("a picture needs a width and a height");
  return std::make_shared<ImageRegion>(std::move(image), x, y, low, high);
}

}  // namespace tribo
