// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "geometry/gmsh.hpp"
#include "geometry/region.hpp"
#include "tests/root.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

namespace tribo {
namespace {

std::string mesh_file(const std::string& name) { return (test::source_root() / "tests/geometry/data" / name).string(); }

std::string mesh_text(const std::string& name) {
  std::ostringstream out;
  out << std::ifstream(mesh_file(name)).rdbuf();
  return out.str();
}

// The same with one text replaced by another.
std::string with_text(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

bool holds(const RegionPtr& region, double x, double y, double z = 0) { return region->contains(Vec3(x, y, z)); }

// Of the polygon through n points of the circle of radius 0.5
double hole(int n) { return 0.125 * n * std::sin(2 * std::numbers::pi / n); }

}  // namespace

TEST_CASE("groups of a plane mesh of Gmsh are bodies with holes", "[geometry][gmsh]") {
  for (const std::string name : {"plate.msh", "plate22.msh"}) {
    INFO(name);
    for (const std::string group : {"plate", "3", ""}) {  // 3 is its number; without a group: all surfaces
      INFO(group);
      const auto plate = outline_body(mesh_file(name), group);
      CHECK(*plate->measure() == Approx(8 - hole(8)).epsilon(1e-12));
      CHECK(holds(plate, 0.1, 0.1));
      CHECK(holds(plate, 2, 1));  // on the line between the halves
      CHECK(holds(plate, 4, 2));
      CHECK_FALSE(holds(plate, 1, 1));  // in the hole
      CHECK_FALSE(holds(plate, 1.3, 1.2));
      CHECK_FALSE(holds(plate, 4.001, 1));
      const Bounds box = plate->bounds();
      CHECK(box.low.head<2>() == Vec<2>(0, 0));
      CHECK(box.high.head<2>() == Vec<2>(4, 2));
    }
    const auto left = outline_body(mesh_file(name), "left half", 2.0, Vec3(10, 0, 0));
    CHECK(*left->measure() == Approx(4 * (4 - hole(8))).epsilon(1e-12));
    CHECK(holds(left, 13.9, 3.9));
    CHECK_FALSE(holds(left, 14.1, 2));
    CHECK_FALSE(holds(left, 12, 2));
    // Lines are the outline themselves
    const auto outer = outline_body(mesh_file(name), "outer edge");
    CHECK(holds(outer, 1, 1));
    CHECK_FALSE(outer->measure());
  }
}

TEST_CASE("groups of a mesh of Gmsh in space are bodies", "[geometry][gmsh]") {
  for (const std::string name : {"solid.msh", "solid22.msh"}) {
    INFO(name);
    const auto part = [&](const std::string& group) { return surface_body(mesh_file(name), 1.0, Vec3::Zero(), group); };
    CHECK(*part("low")->measure() == Approx(1).epsilon(1e-12));   // tetrahedra
    CHECK(*part("high")->measure() == Approx(2).epsilon(1e-12));  // prisms
    CHECK(*part("")->measure() == Approx(3).epsilon(1e-12));
    const auto skin = part("skin of high");  // quadrangles and triangles
    CHECK(holds(skin, 0.5, 0.5, 2.9));
    CHECK_FALSE(holds(skin, 0.5, 0.5, 0.9));
    CHECK(holds(part("low"), 0.5, 0.5, 0.9));
    CHECK_FALSE(holds(part("low"), 0.5, 0.5, 1.1));
  }
}

TEST_CASE("what a mesh of Gmsh does not have is said with what it has", "[geometry][gmsh]") {
  const std::string plate = mesh_file("plate.msh"), solid = mesh_file("solid.msh");
  CHECK_THROWS_WITH(outline_body(plate, "plane"),
                    Catch::Contains("no physical group 'plane' (did you mean 'plate'?)") &&
                        Catch::Contains("'left half' (surfaces)"));
  CHECK_THROWS_WITH(outline_body(plate, "clamped"),
                    Catch::Contains("plate.msh: the outline is not closed: 1 edge ends at"));
  CHECK_THROWS_WITH(outline_body(solid, "low"), Catch::Contains("consists of volumes; surfaces or lines are needed"));
  CHECK_THROWS_WITH(outline_body(solid, "skin of high"), Catch::Contains("not in a plane of constant z"));
  CHECK_THROWS_WITH(surface_body(plate, 1, Vec3::Zero(), "plate"), Catch::Contains("the surface is not closed"));
  CHECK_THROWS_WITH(surface_body("part.stl", 1, Vec3::Zero(), "low"), Catch::Contains("only meshes of Gmsh"));
  CHECK_THROWS_AS(outline_body("/nowhere/at/all.msh"), FileError);
}

TEST_CASE("other forms of meshes of Gmsh are refused with the remedy and the place", "[geometry][gmsh]") {
  const auto message = [](const std::string& content) -> std::string {
    const ScratchFile file("m.msh", content);
    try {
      outline_body(file.path);
      return "none";
    } catch (const FileError& error) {
      const std::string text = error.what();
      return text.substr(text.find("m.msh"));
    }
  };
  const std::string text = mesh_text("plate.msh");
  CHECK(message(with_text(text, "4.1 0 8", "4.1 1 8")) ==
        "m.msh:2:5: this mesh is binary; write it as text: 'gmsh MODEL -2 -format msh41' (without -bin)");
  CHECK_THAT(message(with_text(text, "4.1 0 8", "4 0 8")), Catch::StartsWith("m.msh:2:3: the formats 4.1 and 2.2"));
  CHECK_THAT(message(with_text(text, "\n2 1 2 ", "\n2 1 9 ")),
             Catch::Contains("of type 9 are of higher order") && Catch::Contains("gmsh -order 1"));
  CHECK_THAT(message(with_text(text, "\n4 2 0\n", "\n4 two 0\n")),
             Catch::EndsWith(":3: a number is expected, not 'two'"));
  CHECK(message("solid x") == "m.msh:1:1: this is not a mesh of Gmsh: it does not begin with $MeshFormat");
  CHECK_THAT(message(text.substr(0, text.find("$Elements"))), Catch::Contains("the mesh has no elements"));
  CHECK_THAT(message(text.substr(0, text.size() - 20)),
             Catch::Contains("the end of the file") || Catch::Contains("the file ends before $EndElements"));
  CHECK(message(text) == "none");
}

TEST_CASE("a damaged mesh of Gmsh is an error, never a crash", "[geometry][gmsh]") {
  std::mt19937 random(7);
  for (const std::string name : {"plate.msh", "solid22.msh"}) {
    const std::string text = mesh_text(name);
    for (int n = 0; n < 150; ++n) {
      std::string content = n % 3 == 0 ? text.substr(0, random() % text.size()) : text;
      for (int k = 0; k < n % 3 && !content.empty(); ++k)
        content[random() % content.size()] = "0129-.$x \n"[random() % 10];
      const ScratchFile file("m.msh", content);
      try {
        read_gmsh(file.path);
      } catch (const FileError&) {
      }
    }
  }
}

}  // namespace tribo
