// SPDX-License-Identifier: MIT
/// What is written and drawn around the particles of a picture.
#pragma once

#include "view/camera.hpp"
#include "view/canvas.hpp"
#include "view/shade.hpp"

namespace tribo {

/// Distance of the names of the run and of the field from the upper edge of the frame [pixels].
inline constexpr double above_names = 24;

/// Which point of a text is at its place.
enum class Anchor { left, middle, right };
void write_text(cairo_t* pen, const std::string& text, double x, double y, Anchor anchor = Anchor::left,
                double size = 12);

/// A frame with ticks, and the names of the axes.
void draw_axes(cairo_t* pen, const Sheet& l, const Camera& camera, const std::string& unit);
/// A cross of the three directions where there are no axes.
void draw_directions(cairo_t* pen, const Sheet& l, const Camera& camera);
/// The colours of a range with ticks, below the name of the field.
void draw_scale(cairo_t* pen, const Sheet& l, const Range& range, const std::string& name, const std::string& unit);
/// The colours of categories that occur in `values`, with their names or numbers.
void draw_names(cairo_t* pen, const Sheet& l, const std::vector<double>& values, const std::string& name,
                const std::vector<std::string>& names);

}  // namespace tribo
