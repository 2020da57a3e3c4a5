// SPDX-License-Identifier: MIT
/// Terrain: heights on a regular grid, and the bodies below or between such surfaces.
#pragma once

#include "geometry/region.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// Heights on a regular grid of points in the plane x, y. Between four points the surface is bilinear.
struct HeightGrid {
  int columns = 0, rows = 0;            ///< points along x and y, at least 2
  std::array<double, 2> first{};        ///< x and y of the point of column 0 and row 0 [length]
  std::array<double, 2> spacing{1, 1};  ///< of the points along x and y                [length]
  std::vector<double> heights;          ///< x fastest, from low to high y; not finite where there is none [length]

  double& at(int column, int row) { return heights[place(column, row)]; }
  double at(int column, int row) const { return heights[place(column, row)]; }
  /// The largest coordinate along an axis (0: x, 1: y).
  double last(std::size_t axis) const { return first[axis] + spacing[axis] * ((axis == 0 ? columns : rows) - 1); }
  /// The height at a place; std::nullopt outside of the grid and where a point around it has no height.
  std::optional<double> height(double x, double y) const;
  /// Replaces all coordinates x by scale x + shift.
  void transform(double scale, const Vec3& shift);

 private:
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Reads an ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize and, if some
/// heights are missing, nodata_value, then the heights row by row from the north. The points are the centres of the
/// cells. Throws FileError.
HeightGrid read_height_grid(const std::string& path);
/// Heights from a picture whose first and last pixels are at the edges of a rectangle of `width` and `depth`: black has
/// the height `low`, white `high` [length]. Throws std::runtime_error.
HeightGrid height_grid(const Image& image, double width, double depth, double low, double high);

/// The points below a surface and above the plane z = bottom [length]. Throws std::runtime_error if there are none.
RegionPtr terrain(HeightGrid upper, double bottom);
/// The points below a surface and above another one, where both have heights.
RegionPtr terrain(HeightGrid upper, HeightGrid lower);

}  // namespace tribo
