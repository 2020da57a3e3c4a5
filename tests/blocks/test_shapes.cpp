// SPDX-License-Identifier: MIT
/// Shapes, faces that lie against one another, cells with walls.

#include "blocks/block_cases.hpp"
#include "geometry/point_sets.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

TEST_CASE("masses of polygons and polyhedra", "[blocks]") {
  const auto plate = mass_properties(brick_block({1, 2, 0}, {3, 5, 0}, true), true, 0.5);
  CHECK(plate.volume == Approx(3));
  CHECK((plate.centre - Vec3(2, 3.5, 0)).norm() < 1e-14);
  CHECK(plate.inertia(2, 2) == Approx(3 * (4.0 + 9.0) / 12));
  const auto box = mass_properties(brick_block({1, 2, 3}, {2, 4, 6}, false), false, 1);
  CHECK(box.volume == Approx(6));
  CHECK((box.centre - Vec3(1.5, 3, 4.5)).norm() < 1e-13);
  CHECK(box.inertia(0, 0) == Approx(6 * (4.0 + 9.0) / 12));
  CHECK(box.inertia(2, 2) == Approx(6 * (1.0 + 4.0) / 12));
  CHECK(std::abs(box.inertia(0, 1)) < 1e-12);
  const auto triangle = mass_properties(polygon_block({{0, 0, 0}, {0, 2, 0}, {3, 0, 0}}), true, 1);
  CHECK(triangle.volume == Approx(3));
  CHECK((triangle.centre - Vec3(1, 2.0 / 3, 0)).norm() < 1e-14);
}

TEST_CASE("polygons that are no blocks are refused", "[blocks]") {
  CHECK_THROWS_WITH(polygon_block({{0, 0, 0}, {1, 0, 0}}), Catch::Contains("three"));
  CHECK_THROWS_WITH(polygon_block({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), Catch::Contains("area"));
  CHECK_THROWS_WITH(polygon_block({{0, 0, 0}, {2, 0, 0}, {1, 0.5, 0}, {2, 2, 0}, {0, 2, 0}}),
                    Catch::Contains("convex"));
  CHECK_THROWS_WITH(polygon_block({{0, 1, 0}, {0.6, -0.8, 0}, {-1, 0.3, 0}, {1, 0.3, 0}, {-0.6, -0.8, 0}}),
                    Catch::Contains("crosses"));
}

TEST_CASE("Voronoi cells fill their box and close", "[blocks]") {
  for (const bool plane : {true, false}) {
    const Vec3 size = plane ? Vec3(2, 1, 0) : Vec3(2, 1, 1.5);
    const auto nuclei = scattered(plane ? 400 : 300, size, plane, 0.01);
    const Tessellation cells = voronoi(nuclei, Vec3::Zero(), size, plane, 1.0);
    double volume = 0;
    for (const auto& s : cells.shapes) volume += mass_properties(s, plane, 1.0).volume;
    CHECK(volume == Approx(plane ? 2.0 : 3.0).epsilon(1e-11));
    std::vector<Vec3> closed(nuclei.size(), Vec3::Zero());
    for (const BlockFacet& f : cells.facets) {
      closed[static_cast<std::size_t>(f.a)] += f.geometry.area * f.geometry.normal;
      if (f.b != BlockFacet::none) closed[static_cast<std::size_t>(f.b)] -= f.geometry.area * f.geometry.normal;
    }
    double most = 0;
    for (const Vec3& c : closed) most = std::max(most, c.norm());
    CHECK(most < 1e-8);
  }
  const std::vector<Vec3> twins{{0.5, 0.5, 0}, {0.2, 0.2, 0}, {0.5, 0.5, 0}};
  CHECK_THROWS_WITH(voronoi(twins, Vec3::Zero(), Vec3(1, 1, 0), true, 1.0), Catch::Contains("coincide"));
  CHECK_THROWS_WITH(voronoi(twins, Vec3::Zero(), Vec3(0.4, 1, 0), true, 1.0), Catch::Contains("within the box"));
}

TEST_CASE("cells of lattices are cubes and truncated octahedra", "[blocks]") {
  const Vec3 low = Vec3::Zero(), high = Vec3::Constant(1);
  for (const auto& [lattice, faces, volume] :
       {std::tuple{PointLattice::cubes, 6, 1.0 / 64}, std::tuple{PointLattice::octahedra, 14, 1.0 / 128}}) {
    const auto points = lattice_points(lattice, 0.25, low, high, false);
    const Tessellation cells = voronoi(points, low, high, false, 1.0);
    std::size_t whole = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if ((points[k] - low).minCoeff() < 0.26 || (high - points[k]).minCoeff() < 0.26) continue;
      ++whole;
      CHECK(static_cast<int>(cells.shapes[k].faces.size()) == faces);
      CHECK(mass_properties(cells.shapes[k], false, 1.0).volume == Approx(volume));
    }
    CHECK(whole >= 8);
  }
}

TEST_CASE("faces of blocks that lie against one another are found, and what they share", "[blocks]") {
  for (const bool plane : {true, false}) {
    const std::vector<BlockShape> shapes{brick_block({0, 0, 0}, {1, 1, 1}, plane),
                                         brick_block({1, 0.25, 0.5}, {2, 0.75, 2}, plane)};
    std::vector<BlockFacet> facets;
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t f = 0; f < shapes[k].faces.size(); ++f) {
        BlockFacet one;
        one.a = static_cast<std::int64_t>(k), one.corners = shapes[k].face(f);
        one.geometry = face_geometry(one.corners, plane, 1.0);
        facets.push_back(one);
      }
    const std::vector<std::int64_t> group{0, 1};
    join_faces(group, plane, 1.0, 1e-9, facets);
    std::size_t common = 0, covered = 0;
    for (const BlockFacet& f : facets) {
      covered += f.covered ? 1 : 0;
      if (f.b == BlockFacet::none) continue;
      ++common;
      CHECK(f.geometry.area == Approx(plane ? 0.5 : 0.25));
      CHECK((f.geometry.normal - Vec3::UnitX()).norm() < 1e-14);
      CHECK((f.geometry.centre - Vec3(1, 0.5, plane ? 0 : 0.75)).norm() < 1e-14);
    }
    CHECK(common == 1);
    CHECK(covered == (plane ? 1 : 2));
  }
}
