// SPDX-License-Identifier: MIT
/// A frame of particles, and the pixels of pictures, for tests.
#pragma once

#include "view/colours.hpp"
#include "view/picture.hpp"

#include <png.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace tribo::test {

/// Two rows of three particles a distance of 2 apart; von_mises grows from left to right.
inline ParticleFrame small_frame() {
  ParticleFrame frame;
  frame.time = 1.5;
  frame.fields = {{"von_mises", 1, false, {}}, {"velocity", 3, false, {}}, {"material", 1, true, {}}};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      frame.position.push_back({2.0 * i, 2.0 * j, 0.0});
      frame.fields[0].values.push_back(i);
      for (const double v : {3.0, 4.0, 0.0}) frame.fields[1].values.push_back(v);
      frame.fields[2].values.push_back(1 + j);
    }
  return frame;
}

struct Pixels {
  int width = 0, height = 0;
  std::vector<Colour> colours;
  Colour at(double x, double y) const {
    return colours[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

inline Pixels read_png(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
  image.format = PNG_FORMAT_RGB;
  Pixels out{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  out.colours.resize(static_cast<std::size_t>(image.width) * image.height);
  REQUIRE(png_image_finish_read(&image, nullptr, out.colours.data(), 0, nullptr));
  return out;
}

inline int count(const Pixels& pixels, const Colour& colour) {
  return static_cast<int>(std::count(pixels.colours.begin(), pixels.colours.end(), colour));
}

}  // namespace tribo::test
