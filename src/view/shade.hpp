// SPDX-License-Identifier: MIT
/// The field that a picture shows, and the range of its colours.
#pragma once

#include "view/run_folder.hpp"

#include <optional>

namespace tribo {

/// One number per particle or block, chosen from the fields of a frame by `von_mises`, `velocity` (of a vector its
/// length), `velocity.x`, `stress.xy`.
struct Shade {
  std::string name;
  std::vector<double> values;
  bool integers = false;  ///< categories, not a scale
};
/// Throws UsageError for a field or component that the frame does not have.
Shade shade_of(const ParticleFrame& frame, const std::string& field);
/// Values of the particles, then of the cells of blocks; NaN if they have no such field.
Shade shade_of(const Scene& scene, const std::string& field);

/// The field to draw if none is chosen: von_mises if the scene has it, else another one that it has. Throws UsageError
/// if there is none.
std::string default_field(const Scene& scene);

/// Lowest and highest value that the colours span: all but the outermost half per cent. If all values are equal, a
/// range around them.
using Range = std::array<double, 2>;
Range range_of(const std::vector<double>& values);
/// Extends `range` by the values, without the outermost half per cent of them.
void extend(std::optional<Range>& range, const std::vector<double>& values);
/// The range itself, or, if it contains one value only, a range around it; 0 to 1 if it is empty.
Range widened(const std::optional<Range>& range);

}  // namespace tribo
