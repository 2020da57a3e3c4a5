// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "geometry/region.hpp"
#include "tests/geometry/counting.hpp"
#include "tests/scratch.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

using namespace tribo;
using Triangles = std::vector<std::array<Vec3, 3>>;
using std::numbers::pi;

namespace {

// A unit cube, outward.
Triangles cube() {
  Triangles out;
  const auto face = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    out.push_back({a, b, c});
    out.push_back({a, c, d});
  };
  face({0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0});
  face({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1});
  face({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1});
  face({0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0});
  face({0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0});
  face({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1});
  return out;
}

// A sphere of radius 1 of latitude bands; its poles and meridians lie exactly above lattice points.
Triangles sphere(int bands) {
  Triangles out;
  const auto at = [&](int i, int j) -> Vec3 {
    const double polar = pi * i / bands, around = pi * (j % (2 * bands)) / bands;
    if (i == 0) return {0, 0, 1};
    if (i == bands) return {0, 0, -1};
    return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
  };
  for (int i = 0; i < bands; ++i)
    for (int j = 0; j < 2 * bands; ++j) {
      if (i > 0) out.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i < bands - 1) out.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return out;
}

std::string ascii(const Triangles& triangles) {
  std::ostringstream out;
  out.precision(17);
  out << "solid thing with a name\n";
  for (const auto& t : triangles) {
    out << " facet normal 0 0 nan\n  outer loop\n";
    for (const auto& x : t) out << "   vertex " << x[0] << " " << x[1] << " " << x[2] << "\n";
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid thing\n";
  return out.str();
}

std::string word(std::uint32_t value) {
  std::string out;
  for (int k = 0; k < 4; ++k) out += static_cast<char>(value >> (8 * k) & 0xFF);
  return out;
}

std::string binary(const Triangles& triangles) {
  std::string out = "solid is how some binary files begin";
  out.resize(80, ' ');
  out += word(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& t : triangles) {
    out += std::string(12, '\0');
    for (const auto& x : t)
      for (int k = 0; k < 3; ++k) out += word(std::bit_cast<std::uint32_t>(static_cast<float>(x[k])));
    out += std::string(2, '\0');
  }
  return out;
}

bool within_surface(const RegionPtr& region, double x, double y, double z) { return region->contains(Vec3(x, y, z)); }

}  // namespace

TEST_CASE("a cube of facets contains what the box contains, faces and edges included", "[geometry][surface]") {
  const auto facets = polyhedron(cube());
  const auto exact = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  for (int k = -2; k <= 12; ++k)
    for (int j = -2; j <= 12; ++j)
      for (int i = -2; i <= 12; ++i) {
        const Vec3 x(0.1 * i, 0.1 * j, 0.1 * k);
        CAPTURE(x);
        REQUIRE(facets->contains(x) == exact->contains(x));
      }
  CHECK(*facets->measure() == Approx(1).epsilon(1e-14));
}

TEST_CASE("a turned cube of facets contains what the turned box contains", "[geometry][surface]") {
  const auto exact = move(box(Vec3(0, 0, 0), Vec3(1, 1, 1)), Vec3(1, 2, 3), 0.9, Vec3(0.5, 0.5, 0.5), Vec3(7, 8, 9));
  const auto facets = move(polyhedron(cube()), Vec3(1, 2, 3), 0.9, Vec3(0.5, 0.5, 0.5), Vec3(7, 8, 9));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.4, 1.4);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 x(7 + shift(random), 8 + shift(random), 9 + shift(random));
    REQUIRE(facets->contains(x) == exact->contains(x));
  }
}

TEST_CASE("the inside test is correct for rays through corners and edges", "[geometry][surface]") {
  const auto ball = polyhedron(sphere(24));
  // The facets lie between the spheres of radius 1 and of cos^2 of half a band's angle.
  const double inner = std::cos(pi / 48) * std::cos(pi / 48);
  const double h = 1.0 / 16;
  for (int k = -18; k <= 18; ++k)
    for (int j = -18; j <= 18; ++j)
      for (int i = -18; i <= 18; ++i) {
        const Vec3 x(h * i, h * j, h * k);
        CAPTURE(x);
        if (x.norm() < inner - 1e-9) REQUIRE(ball->contains(x));
        if (x.norm() > 1 + 1e-9) REQUIRE_FALSE(ball->contains(x));
      }
  check_measure(*ball, 3, 12.6, 0.05);
  // Columns of points exactly above the meridians
  for (int j = 0; j < 48; ++j)
    for (const double r : {0.2, 0.5, 0.9}) {
      REQUIRE(within_surface(ball, r * std::cos(pi * j / 24), r * std::sin(pi * j / 24), 0.01));
      REQUIRE_FALSE(within_surface(ball, r * std::cos(pi * j / 24), r * std::sin(pi * j / 24), -1.1));
    }
}

TEST_CASE("a cavity is outside", "[geometry][surface]") {
  auto triangles = cube();
  for (auto t : cube()) {
    for (auto& x : t) x = Vec3(0.25, 0.25, 0.25) + 0.5 * x;
    triangles.push_back({t[0], t[2], t[1]});
  }
  const auto hollow = polyhedron(triangles);
  CHECK(within_surface(hollow, 0.1, 0.5, 0.5));
  CHECK_FALSE(within_surface(hollow, 0.5, 0.5, 0.5));
  CHECK(*hollow->measure() == Approx(0.875).epsilon(1e-14));
}

TEST_CASE("facets may have any orientation, but then the volume is not known", "[geometry][surface]") {
  auto triangles = cube();
  std::swap(triangles[3][0], triangles[3][1]);
  const auto mixed = polyhedron(triangles);
  CHECK(within_surface(mixed, 0.5, 0.5, 0.5));
  CHECK_FALSE(within_surface(mixed, 0.5, 0.5, 1.5));
  CHECK_FALSE(mixed->measure().has_value());
}

TEST_CASE("an open surface is refused with the coordinates of the gap", "[geometry][surface]") {
  auto open = cube();
  open.pop_back();
  CHECK_THROWS_WITH(polyhedron(open), Catch::Contains("not closed") && Catch::Contains("from (1, 0, 1) to (1, 1, 1)") &&
                                          Catch::Contains("belongs to 1 facet instead of 2"));
  auto doubled = cube();
  doubled.push_back(doubled.front());
  CHECK_THROWS_WITH(polyhedron(doubled), Catch::Contains("belongs to 3 facets"));
  CHECK_THROWS_WITH(polyhedron({}), "the surface has no facets");
}

TEST_CASE("STL files are read in both forms", "[geometry][surface]") {
  for (const auto& content : {ascii(cube()), binary(cube())}) {
    const ScratchFile file("cube.stl", content);
    const auto body = surface_body(file.path, 2.0, Vec3(10, 0, 0));
    CHECK(*body->measure() == Approx(8).epsilon(1e-12));
    CHECK(within_surface(body, 11.9, 1.9, 1.9));
    CHECK_FALSE(within_surface(body, 9.9, 1, 1));
    CHECK(read_stl(file.path).size() == 12);
  }
}

TEST_CASE("OBJ and PLY files are read, with polygons", "[geometry][surface]") {
  const std::string obj =
      "# a cube of quadrilaterals\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
      "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 3 7 6 2\n4 0 4 7 3\n4 1 2 6 5\n";
  for (const auto& [name, content] : {std::pair{"cube.obj", obj}, {"CUBE.PLY", ply}}) {
    const ScratchFile file(name, content);
    CHECK(read_surface(file.path).size() == 12);
    const auto body = surface_body(file.path, 2.0, Vec3(10, 0, 0));
    CHECK(*body->measure() == Approx(8).epsilon(1e-6));
    CHECK(within_surface(body, 11.9, 1.9, 1.9));
  }
  const ScratchFile open("open.obj", obj.substr(0, obj.rfind("f 2")));
  CHECK_THROWS_WITH(surface_body(open.path), Catch::Contains("open.obj: the surface is not closed"));
  const ScratchFile empty("empty.obj", "nothing here\n"), other("cube.step", obj);
  CHECK_THROWS_WITH(read_surface(empty.path), Catch::Contains("no facets were found"));
  CHECK_THROWS_WITH(read_surface(other.path), Catch::Contains(".stl, .obj, .ply or .msh, not with '.step'"));
  CHECK_THROWS_AS(read_surface("/nowhere/at/all.ply"), FileError);
}

TEST_CASE("corners that differ in the last bits of single precision are one", "[geometry][surface]") {
  auto triangles = sphere(8);
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (auto& x : triangles[k]) x *= 1.0 + 1e-7 * static_cast<double>(k % 3);
  const ScratchFile file("noisy.stl", binary(triangles));
  CHECK_NOTHROW(surface_body(file.path));
}

TEST_CASE("a broken STL file is a file error, never a crash", "[geometry][surface]") {
  CHECK_THROWS_AS(surface_body("/nowhere/at/all.stl"), FileError);
  CHECK_THROWS_AS(surface_body("/tmp"), FileError);
  auto open = cube();
  open.erase(open.begin());
  const ScratchFile gap("gap.stl", ascii(open));
  CHECK_THROWS_WITH(surface_body(gap.path), Catch::Contains("gap.stl: the surface is not closed"));
  const ScratchFile wrong("wrong.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n");
  CHECK_THROWS_WITH(surface_body(wrong.path), Catch::Contains("wrong.stl:4:12: a number is expected, not 'zero'"));

  for (const auto& content : {ascii(cube()), binary(cube())})
    for (std::size_t length = 0; length + 20 < content.size(); length += 7) {
      const ScratchFile file("cut.stl", content.substr(0, length));
      CHECK_THROWS_AS(read_stl(file.path), FileError);
    }
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n) {
    auto content = n % 2 ? ascii(cube()) : binary(cube());
    for (int k = 0; k < 3; ++k) content[random() % content.size()] = static_cast<char>(random());
    const ScratchFile file("flipped.stl", content);
    try {
      (void)surface_body(file.path);
    } catch (const std::runtime_error&) {
    }
  }
}
