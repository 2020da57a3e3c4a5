// SPDX-License-Identifier: MIT
/// The part of space that a picture shows.
#pragma once

#include "view/camera.hpp"

#include <array>
#include <string>
#include <vector>

namespace tribo {

/// Limits of a picture along the directions of its camera: right and up [length].
struct Window {
  double left, right, low, high;
};

/// What shows a box, with a margin.
Window window_around(const Camera& eye, const std::array<std::array<double, 3>, 2>& box);

/// What the options `--window`, `--zoom` and `--centre` of `tribo render` say.
struct WindowOptions {
  std::vector<double> limits;  ///< left, right, low, high; empty: the whole, or what `zoom` says
  double zoom = 1.0;           ///< magnification of the window around everything
  std::vector<double> centre;  ///< point in the middle of a magnified picture; empty: the middle of the box
};

/// The window for a view and what there is to draw, the box. Throws UsageError if limits are not in order, show nothing
/// of the box, or belong to a view whose directions are no axes; if the magnification is not positive; and if the
/// centre lies outside of the box.
Window chosen_window(const WindowOptions& options, const std::string& view,
                     const std::array<std::array<double, 3>, 2>& box);

}  // namespace tribo
