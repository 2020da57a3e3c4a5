// SPDX-License-Identifier: MIT
/// Pictures of particles and blocks, drawn without a screen.
#pragma once

#include "view/camera.hpp"
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

struct PictureOptions {
  std::string field;        ///< empty: default_field()
  std::string unit;         ///< shown next to the name of the field
  std::string time_unit;    ///< shown after the time
  std::string length_unit;  ///< shown at the axes
  /// Names of the materials in their order, shown for the field `material`; empty: numbers.
  std::vector<std::string> materials;
  std::string view;            ///< of camera(); empty: xy if all particles lie in it, else iso
  int width = 900;             ///< pixels
  std::optional<Range> range;  ///< of the colours; empty: of the frame
  /// What the picture shows, low and high corner; empty: the frame with a margin.
  std::optional<std::array<std::array<double, 3>, 2>> box;
};

/// The picture as a PNG file's bytes: particles as squares or balls, blocks as polygons with their edges, grey where
/// they lack the field, and on them red where a bond between blocks failed in tension and blue where it failed in
/// shear. Throws UsageError like shade_of, FileError if there is nothing to draw.
std::string picture(const Scene& scene, const PictureOptions& options);
std::string picture(const ParticleFrame& frame, const PictureOptions& options);

/// The bytes of a PNG file with a text that says it was made by `tribo render`.
std::string marked_as_rendered(const std::string& png);
/// Whether a file is such a picture, or a film that ends with `film_mark()`.
bool is_rendered(const std::filesystem::path& file);
/// To be appended to a film: a box without meaning for players.
std::string film_mark();

/// The bounding box of particles and blocks.
std::array<std::array<double, 3>, 2> box_of(const ParticleFrame& frame);
std::array<std::array<double, 3>, 2> box_of(const Scene& scene);
std::array<std::array<double, 3>, 2> joined(const std::array<std::array<double, 3>, 2>& a,
                                            const std::array<std::array<double, 3>, 2>& b);

}  // namespace tribo
