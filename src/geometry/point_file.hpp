// SPDX-License-Identifier: MIT
/// Points with values, from files of VTK.
#pragma once

#include "base/types.hpp"

#include <string>
#include <vector>

namespace tribo {

struct PointFile {
  /// Values at the points, `components` successive ones for each.
  struct Array {
    std::string name;
    std::size_t components = 1;
    std::vector<double> values;
  };
  std::vector<Vec3> position;  ///< in the unit of the file
  std::vector<Array> arrays;   ///< of numbers; arrays of texts are left out
};

/// The points of a file whose name ends with .vtp, .vtu or .vtk, with the arrays of its points. Throws FileError if it
/// cannot be read or has no points.
PointFile read_point_file(const std::string& path);

/// The same for the older format of VTK, whose files begin with "# vtk DataFile" and whose names end with .vtk.
PointFile read_legacy_point_file(const std::string& path);

}  // namespace tribo
