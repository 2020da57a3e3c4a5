// SPDX-License-Identifier: MIT
#include "view/colours.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

Colour viridis(double part) {
  // every sixteenth of the map
  static constexpr std::array<Colour, 17> keys{{{68, 1, 84},
                                                {72, 24, 106},
                                                {71, 45, 123},
                                                {66, 64, 134},
                                                {59, 82, 139},
                                                {51, 99, 141},
                                                {44, 114, 142},
                                                {38, 130, 142},
                                                {33, 145, 140},
                                                {31, 160, 136},
                                                {40, 174, 128},
                                                {63, 188, 115},
                                                {94, 201, 98},
                                                {132, 212, 75},
                                                {173, 220, 48},
                                                {216, 226, 25},
                                                {253, 231, 37}}};
  const double at = (std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.0) * (keys.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), keys.size() - 2);
  const double share = at - static_cast<double>(k);
  Colour out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(std::lround((1 - share) * keys[k][c] + share * keys[k + 1][c]));
  return out;
}

Colour distinct(int k) {
  static constexpr std::array<Colour, 10> all{{{0, 114, 178},
                                               {230, 159, 0},
                                               {0, 158, 115},
                                               {204, 121, 167},
                                               {86, 180, 233},
                                               {213, 94, 0},
                                               {240, 228, 66},
                                               {110, 110, 110},
                                               {150, 90, 60},
                                               {180, 180, 180}}};
  return all[static_cast<std::size_t>(((k % 10) + 10) % 10)];
}

}  // namespace tribo
