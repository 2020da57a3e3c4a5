// SPDX-License-Identifier: MIT
/// Surfaces from files in the formats of other programs. VTK reads OBJ and PLY files.
#include "base/error.hpp"
#include "geometry/file.hpp"
#include "geometry/region.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObject.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace tribo {
namespace {

using Facets = std::vector<std::array<Vec3, 3>>;

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// The polygons of a file as fans of triangles. `format`: for messages.
template <class Reader>
Facets read_with(const std::string& path, const char* format) {
  const Bytes bytes(path);  // says why if the file cannot be read
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<Reader> reader;
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
  if (out.empty()) bytes.fail(std::string("no facets were found; this is not a complete ") + format + " file");
  return out;
}

}  // namespace

std::vector<std::array<Vec3, 3>> read_surface(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".stl") return read_stl(path);
  if (ending == ".obj") return read_with<vtkOBJReader>(path, "OBJ");
  if (ending == ".ply") return read_with<vtkPLYReader>(path, "PLY");
  throw FileError(path + ": the name of a surface file ends with .stl, .obj or .ply, not with '" + ending +
                  "'; Gmsh writes its meshes as STL with 'gmsh MODEL -2 -format stl'");
}

}  // namespace tribo
