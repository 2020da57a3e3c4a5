// SPDX-License-Identifier: MIT
/// Points from files that VTK has written, in all its forms: tests/geometry/data/points_*.

#include "base/error.hpp"
#include "geometry/point_file.hpp"
#include "tests/root.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

using namespace tribo;

namespace {

const std::vector<std::string> point_files{"points_ascii.vtu",       "points_binary.vtu", "points_binary_zlib.vtp",
                                           "points_base64_zlib.vtu", "points_raw.vtp",    "points_raw_zlib.vtu",
                                           "points_ascii.vtk",       "points_binary.vtk", "points_ascii42.vtk",
                                           "points_binary42.vtk"};

std::filesystem::path point_file(const std::string& name) {
  return tribo::test::source_root() / "tests/geometry/data" / name;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const PointFile::Array* named(const PointFile& points, const std::string& name) {
  const auto found =
      std::find_if(points.arrays.begin(), points.arrays.end(), [&](const auto& a) { return a.name == name; });
  return found == points.arrays.end() ? nullptr : &*found;
}

std::string complaint_of(const std::string& ending, const std::string& content) {
  const ScratchFile file("points" + ending, content);
  try {
    read_point_file(file.path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("points and their values are read in all forms in which VTK writes them", "[geometry][vtk]") {
  for (const auto& name : point_files) {
    INFO(name);
    const PointFile points = read_point_file(point_file(name));
    REQUIRE(points.position.size() == 3);
    CHECK(points.position[1] == Vec3(1.25, -2, 3));
    CHECK(points.position[2] == Vec3(4, 5, 6e-3));
    CHECK(points.arrays.size() == 3);
    CHECK(!named(points, "of_cells"));
    const auto *mass = named(points, "mass"), *velocity = named(points, "velocity"), *id = named(points, "id");
    REQUIRE((mass && velocity && id));
    CHECK(mass->values == std::vector<double>{1.5, 2.5, -3.25e-7});
    CHECK(velocity->components == 3);
    CHECK(velocity->values == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9});
    CHECK(id->values == std::vector<double>{7, 8, -9});
  }
}

TEST_CASE("a damaged file of points is an error, never a crash", "[geometry][vtk]") {
  std::mt19937 random(11);
  for (const auto& name : point_files) {
    INFO(name);
    const std::string whole = bytes_of(point_file(name)), ending = name.substr(name.size() - 4);
    CHECK(complaint_of(ending, whole) == "none");
    CHECK(complaint_of(ending, whole.substr(0, ending == ".vtk" ? 90 : whole.size() / 2)) != "none");
    for (int n = 0; n < 200; ++n) {
      std::string content = n % 4 == 0 ? whole.substr(0, random() % whole.size()) : whole;
      for (int k = 0; k < n % 4 && !content.empty(); ++k)
        content[random() % content.size()] =
            n % 2 == 0 ? static_cast<char>(random() % 256) : "0129-.<=\" \n"[random() % 11];
      complaint_of(ending, content);
    }
  }
}

TEST_CASE("messages about files of points", "[geometry][vtk]") {
  const auto with = [](const std::string& name, const std::string& from, const std::string& to) {
    std::string text = bytes_of(point_file(name));
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  };
  using Catch::Contains;
  CHECK_THAT(complaint_of(".vtu", "points"), Contains("it is not an XML file of VTK"));
  CHECK_THAT(complaint_of(".vtu", with("points_ascii.vtu", "UnstructuredGrid", "ImageData")), Contains("'ImageData'"));
  CHECK_THAT(complaint_of(".vtu", with("points_ascii.vtu", "NumberOfPoints=\"3\"", "NumberOfPoints=\"4\"")),
             Contains("has another size than the file says"));
  CHECK_THAT(complaint_of(".vtu", with("points_ascii.vtu", "NumberOfPoints=\"3\"", "NumberOfPoints=\"1e14\"")),
             Contains("numbers"));
  CHECK_THAT(complaint_of(".vtu", with("points_ascii.vtu", "2.5 -3.25e-7", "2.5 nan")),
             Contains("point 3 has a value of 'mass' that is not finite") || Contains("contains 'nan'"));
  CHECK_THAT(complaint_of(".vtu", with("points_raw_zlib.vtu", "vtkZLibDataCompressor", "vtkLZ4DataCompressor")),
             Contains("not by zlib"));
  CHECK_THAT(complaint_of(".vtp", with("points_raw.vtp", "LittleEndian", "BigEndian")), Contains("LittleEndian"));
  CHECK_THAT(complaint_of(".vtk", "x"), Contains("does not begin with '# vtk DataFile Version'"));
  CHECK_THAT(complaint_of(".vtk", with("points_ascii.vtk", "POINTS 3", "POINTS 4000000000")),
             Contains(":5:1: the file is cut off"));
  CHECK_THAT(complaint_of(".vtk", with("points_ascii.vtk", "UNSTRUCTURED_GRID", "STRUCTURED_POINTS")),
             Contains("has no points"));
  CHECK_THAT(complaint_of(".vtk", with("points_ascii.vtk", "POINT_DATA 3", "POINT_DATA 2")),
             Contains("there are 2 values, but 3 points"));
  CHECK_THAT(complaint_of(".vtk", with("points_ascii.vtk", "CELL_TYPES", "CELL_KINDS")),
             Contains("the keyword 'CELL_KINDS' is not known"));
}
