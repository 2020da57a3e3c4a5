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
  bool integers = false;  ///< things to tell apart, not a scale
};
/// Throws UsageError for a field or component that the frame does not have.
Shade shade_of(const ParticleFrame& frame, const std::string& field);
/// Of what the scene shows: particles, then the cells of blocks; not a number where either has no such field.
Shade shade_of(const Scene& scene, const std::string& field);

/// Lowest and highest value that the colours span: all but the outermost half per cent.
using Range = std::array<double, 2>;
Range range_of(const std::vector<double>& values);

struct PictureOptions {
  std::string field = "von_mises";
  std::string unit;            ///< shown beside the field
  std::string time_unit;       ///< shown behind the time
  std::string view;            ///< of camera(); empty: xy if all particles lie in it, else iso
  int width = 900;             ///< pixels
  std::optional<Range> range;  ///< of the colours; empty: of the frame
  /// What the picture shows, low and high corner; empty: the frame with a margin.
  std::optional<std::array<std::array<double, 3>, 2>> box;
};

/// The picture as a PNG file's bytes: particles as squares or balls, blocks as polygons with their edges, grey where
/// they lack the field, and on them red where a bond between blocks tore and blue where it sheared. Throws UsageError
/// like shade_of, FileError if there is nothing to draw.
std::string picture(const Scene& scene, const PictureOptions& options);
std::string picture(const ParticleFrame& frame, const PictureOptions& options);

/// The box that holds all there is to see.
std::array<std::array<double, 3>, 2> box_of(const ParticleFrame& frame);
std::array<std::array<double, 3>, 2> box_of(const Scene& scene);
std::array<std::array<double, 3>, 2> joined(const std::array<std::array<double, 3>, 2>& a,
                                            const std::array<std::array<double, 3>, 2>& b);

}  // namespace tribo
