// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "geometry/terrain.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;

namespace {

// Heights x + 10 y at the centres of cells of 2, of which the lowest is at (1, 11).
const std::string plane =
    "ncols 4\nnrows 3\nXLLCORNER 0\nyllcorner 10\ncellsize 2\nNODATA_value -9999\n"
    "151 153 155 157\n131 133 135 137\n111 113 115 117\n";

}  // namespace

TEST_CASE("heights of a grid file are interpolated", "[geometry][terrain]") {
  const ScratchFile file("plane.asc", plane);
  const HeightGrid grid = read_height_grid(file.path);
  CHECK(grid.first == std::array<double, 2>{1, 11});
  CHECK(grid.last(0) == 7);
  CHECK(grid.last(1) == 15);
  for (const auto& [x, y] : {std::pair{1.0, 11.0}, {2.5, 12.25}, {7.0, 15.0}, {4.2, 14.9}})
    CHECK(*grid.height(x, y) == Approx(x + 10 * y).epsilon(1e-14));
  CHECK_FALSE(grid.height(0.9, 12));
  CHECK_FALSE(grid.height(3, 15.1));
}

TEST_CASE("the body below a terrain contains what is below its surface", "[geometry][terrain]") {
  const ScratchFile file("plane.asc", plane);
  const auto body = terrain(read_height_grid(file.path), 50.0);
  CHECK(body->contains({2.5, 12.25, 124.9}));
  CHECK_FALSE(body->contains({2.5, 12.25, 125.1}));
  CHECK(body->contains({2.5, 12.25, 50.0}));
  CHECK_FALSE(body->contains({2.5, 12.25, 49.9}));
  CHECK_FALSE(body->contains({0.5, 12, 60}));
  CHECK(*body->measure() == Approx(6 * 4 * (4 + 130 - 50)).epsilon(1e-13));
  CHECK(body->bounds().low.isApprox(Vec3(1, 11, 50)));
  CHECK(body->bounds().high.isApprox(Vec3(7, 15, 157)));
}

TEST_CASE("a terrain has no body where heights are missing", "[geometry][terrain]") {
  std::string text = plane;
  text.replace(text.find("133"), 3, "-9999");
  const ScratchFile file("gap.asc", text);
  const auto body = terrain(read_height_grid(file.path), 0.0);
  CHECK_FALSE(body->contains({2.0, 12.0, 1.0}));
  CHECK_FALSE(body->contains({3.0, 13.0, 1.0}));
  CHECK(body->contains({6.0, 12.0, 1.0}));
  CHECK(*body->measure() == Approx(2 * 2 * (6 + 120 + 6 + 140)).epsilon(1e-13));  // the last column of pieces
}

TEST_CASE("a body lies between two surfaces", "[geometry][terrain]") {
  const ScratchFile file("plane.asc", plane);
  HeightGrid upper = read_height_grid(file.path);
  upper.transform(1.0, Vec3(0, 0, 3));
  const auto body = terrain(upper, read_height_grid(file.path));
  CHECK(body->contains({2.5, 12.25, 126.0}));
  CHECK_FALSE(body->contains({2.5, 12.25, 124.9}));
  CHECK_FALSE(body->contains({2.5, 12.25, 128.1}));
  CHECK_FALSE(body->measure());
}

TEST_CASE("broken grid files are file errors", "[geometry][terrain]") {
  const auto fails = [](const std::string& text, const std::string& message) {
    const ScratchFile file("broken.asc", text);
    CHECK_THROWS_WITH(read_height_grid(file.path), Catch::Contains(message));
  };
  fails("", "lacks 'ncols'");
  fails("some words that are no grid", "not an ESRI ASCII grid");
  fails("ncols 1\nnrows 3\n", "'ncols' must be a whole number from 2");
  fails("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n1 2 3 4", "'cellsize' must be positive");
  fails("ncols 2\nnrows 2\nyllcorner 0\ncellsize 1\n1 2 3 4", "lacks 'xllcorner'");
  fails(plane.substr(0, plane.size() - 4), "row 3, column 4 is missing");
  fails(plane + " 5", "more heights than ncols times nrows");
  fails(plane.substr(0, plane.size() - 4) + "x7", "is no number: 'x7'");
  const ScratchFile file("plane.asc", plane);
  CHECK_THROWS_WITH(terrain(read_height_grid(file.path), 1000.0), Catch::Contains("above all heights"));
}
