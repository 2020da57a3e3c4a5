// SPDX-License-Identifier: MIT
/// Vectors of a state that the live page draws as arrows.
#pragma once

#include "view/drawn.hpp"

#include <string>
#include <vector>

namespace tribo {

struct Arrows {
  std::string field;  ///< whose unit the vectors have
  std::vector<std::array<double, 3>> places, vectors;
  std::size_t total = 0;  ///< before they were thinned
  double largest = 0.0;   ///< length of the longest of all
};

/// What can be drawn as arrows: fields of vectors, and `contact forces`.
std::vector<std::string> arrow_names(const Scene& scene);

/// The vectors of a field at the particles that are drawn and at visible blocks, or contact forces: tractions at
/// particles in contact and forces between blocks. At most `most`, taken evenly. None for an empty name. Throws
/// UsageError for an unknown one.
Arrows arrows_of(const Scene& scene, const std::string& name, const Drawn& shown, const Wanted& wanted,
                 std::size_t most);

}  // namespace tribo
