// SPDX-License-Identifier: MIT
#include "geometry/point_file.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "base/vtk_file.hpp"

#include <cmath>
#include <filesystem>

namespace tribo {
namespace {

PointFile read_xml_point_file(const std::string& path) {
  const VtkFile file(path);
  if (file.kind() != "PolyData" && file.kind() != "UnstructuredGrid")
    file.fail("it contains '" + printable(file.kind()) + "' and not PolyData or UnstructuredGrid");
  const std::size_t n = file.points();
  const auto* points = file.first("Points");
  if (n == 0 || !points || file.components(*points) != 3) file.fail("it has no points");
  PointFile out;
  const auto x = file.numbers(*points, 3 * n);
  out.position.resize(n);
  for (std::size_t i = 0; i < n; ++i) out.position[i] = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  for (const auto& array : file.arrays()) {
    if (array.section != "PointData") continue;
    auto& to = out.arrays.emplace_back();
    to.name = printable(VtkFile::word(array.words, "Name"));
    to.components = static_cast<std::size_t>(file.components(array));
    to.values = file.numbers(array, n * to.components);
  }
  return out;
}

void check_finite(const PointFile& points, const std::string& path) {
  const auto fail = [&](std::size_t i, const std::string& what) {
    throw FileError(printable(path) + ": point " + std::to_string(i + 1) + " has a " + what + " that is not finite");
  };
  for (std::size_t i = 0; i < points.position.size(); ++i)
    if (!points.position[i].allFinite()) fail(i, "coordinate");
  for (const auto& array : points.arrays)
    for (std::size_t k = 0; k < array.values.size(); ++k)
      if (!std::isfinite(array.values[k])) fail(k / array.components, "value of '" + array.name + "'");
}

}  // namespace

PointFile read_point_file(const std::string& path) {
  const std::string ending = lower(std::filesystem::path(path).extension().string());
  if (ending != ".vtp" && ending != ".vtu" && ending != ".vtk")
    throw FileError(path + ": the name of a VTK file with points ends with .vtp, .vtu or .vtk, not with '" + ending +
                    "'");
  PointFile out = ending == ".vtk" ? read_legacy_point_file(path) : read_xml_point_file(path);
  check_finite(out, path);
  return out;
}

}  // namespace tribo
