// SPDX-License-Identifier: MIT
/// Surfaces from files in the formats of other programs. VTK reads PLY files; its reader of OBJ files needs a third
/// more libraries than the whole program.
#include "base/error.hpp"
#include "base/schema.hpp"
#include "geometry/file.hpp"
#include "geometry/gmsh.hpp"
#include "geometry/region.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace tribo {
namespace {

using Facets = std::vector<std::array<Vec3, 3>>;

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// Corners and faces of an OBJ file; the faces as fans of triangles. A corner of a face is `number`, `number/texture` or
// `number/texture/normal`; negative numbers count from the last point so far.
Facets read_obj(const std::string& path) {
  const Bytes bytes(path);
  std::istringstream lines{std::string(bytes.text())};
  std::vector<Vec3> points;
  Facets out;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto fail = [&](const std::string& why) { bytes.fail("line " + std::to_string(number) + ": " + why); };
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec3 x;
      for (double& value : x) {
        words >> word;
        const auto read = words ? to_number(word) : std::nullopt;
        if (!read || !std::isfinite(*read)) fail("a point has three coordinates");
        value = *read;
      }
      points.push_back(x);
    } else if (word == "f") {
      std::vector<Vec3> corners;
      while (words >> word) {
        const auto read = to_number(word.substr(0, word.find('/')));
        const double place = !read ? 0.0 : *read < 0 ? static_cast<double>(points.size()) + 1 + *read : *read;
        if (!(place >= 1 && place <= static_cast<double>(points.size())) || place != std::floor(place))
          fail("'" + word.substr(0, 40) + "' is not the number of a point before this line");
        corners.push_back(points[static_cast<std::size_t>(place) - 1]);
      }
      for (std::size_t i = 2; i < corners.size(); ++i) out.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  if (out.empty()) bytes.fail("no facets were found; this is not a complete OBJ file");
  return out;
}

// The polygons of a PLY file as fans of triangles.
Facets read_ply(const std::string& path) {
  const Bytes bytes(path);  // says why if the file cannot be read
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  const auto corner = [&](vtkIdType number) {
    Vec3 x;
    data->GetPoint(number, x.data());
    if (!x.allFinite()) bytes.fail("point " + std::to_string(number + 1) + " has a coordinate that is not finite");
    return x;
  };
  Facets out;
  vtkIdType count = 0;
  const vtkIdType* numbers = nullptr;
  vtkCellArray* polygons = data ? data->GetPolys() : nullptr;
  for (vtkIdType k = 0; polygons && k < polygons->GetNumberOfCells(); ++k) {
    polygons->GetCellAtId(k, count, numbers);
    for (vtkIdType i = 0; i < count; ++i)
      if (numbers[i] < 0 || numbers[i] >= data->GetNumberOfPoints())
        bytes.fail("facet " + std::to_string(k + 1) + " has a corner that the file does not contain");
    for (vtkIdType i = 2; i < count; ++i)
      out.push_back({corner(numbers[0]), corner(numbers[i - 1]), corner(numbers[i])});
  }
  if (out.empty()) bytes.fail("no facets were found; this is not a complete PLY file");
  return out;
}

}  // namespace

std::vector<std::array<Vec3, 3>> read_surface(const std::string& path, const std::string& group) {
  const std::string ending = ending_of(path);
  if (ending == ".msh") return gmsh_surface(path, group);
  if (!group.empty())
    throw FileError(path + ": only meshes of Gmsh (.msh) have physical groups such as '" + group + "'");
  if (ending == ".stl") return read_stl(path);
  if (ending == ".obj") return read_obj(path);
  if (ending == ".ply") return read_ply(path);
  throw FileError(path + ": the name of a surface file ends with .stl, .obj, .ply or .msh, not with '" + ending + "'");
}

}  // namespace tribo
