// SPDX-License-Identifier: MIT
/// Pictures of particles and blocks, drawn without a screen.
#pragma once

#include "view/camera.hpp"
#include "view/shade.hpp"
#include "view/window.hpp"

namespace tribo {

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
  std::optional<Window> window;  ///< the part of the picture that is drawn; empty: everything, with a margin
};

/// The picture as a PNG file's bytes: particles as squares or balls, blocks as polygons with their edges, grey where
/// they lack the field, and on them red where a bond between blocks failed in tension and blue where it failed in
/// shear. Throws UsageError like shade_of, FileError if there is nothing to draw.
std::string picture(const Scene& scene, const PictureOptions& options);
std::string picture(const ParticleFrame& frame, const PictureOptions& options);

/// The view that is taken if none is chosen: xy if the box lies in a plane normal to z, else iso.
std::string usual_view(const std::array<std::array<double, 3>, 2>& box);

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
