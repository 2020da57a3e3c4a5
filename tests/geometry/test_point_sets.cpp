// SPDX-License-Identifier: MIT
#include "geometry/point_sets.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

using namespace tribo;

TEST_CASE("random points keep their distance, lie inside, and are reproducible for a seed", "[geometry]") {
  const Vec3 low(1, 2, 3), high(3, 3, 5);
  for (const bool plane : {true, false}) {
    const std::size_t count = 300;
    const auto points = random_points(count, low, high, plane, 0.7, 5);
    REQUIRE(points.size() == count);
    const double due = plane ? std::sqrt(2.0 / 300) : std::cbrt(4.0 / 300);
    double nearest = 1e300;
    for (std::size_t i = 0; i < count; ++i) {
      for (int d = 0; d < (plane ? 2 : 3); ++d) CHECK((points[i][d] > low[d] && points[i][d] < high[d]));
      if (plane) CHECK(points[i][2] == low[2]);
      for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (points[i] - points[j]).norm());
    }
    CHECK(nearest >= 0.7 * due);
    CHECK(nearest < 0.75 * due);
    CHECK(random_points(count, low, high, plane, 0.7, 5) == points);
    CHECK(random_points(count, low, high, plane, 0.7, 6) != points);
  }
  CHECK(random_points(1, low, high, true, 0.6, 1).size() == 1);
  CHECK(random_points(50, low, high, true, 0.0, 1).size() == 50);
  CHECK_THROWS_AS(random_points(500, low, high, true, 1.05, 1), std::runtime_error);
}

TEST_CASE("lattices fill a box from its low corner on", "[geometry]") {
  const Vec3 low(1, -1, 2), high = low + Vec3(1, 0.6, 0.4);
  const auto cubes = lattice_points(PointLattice::cubes, 0.2, low, high, false);
  CHECK(cubes.size() == 5 * 3 * 2);
  CHECK((cubes.front() - low - Vec3::Constant(0.1)).norm() < 1e-14);
  CHECK(lattice_points(PointLattice::cubes, 0.2, low, high, true).size() == 5 * 3);
  const auto octahedra = lattice_points(PointLattice::octahedra, 0.2, low, high, false);
  CHECK(octahedra.size() == 2 * 5 * 3 * 2);
  CHECK((octahedra.front() - low - Vec3::Constant(0.05)).norm() < 1e-14);
  const auto hexagons = lattice_points(PointLattice::hexagons, 0.2, low, high, true);
  CHECK(hexagons.size() == 6 * 3);
  CHECK((hexagons[3] - hexagons[0] - Vec3(0.1 * std::sqrt(3), 0.1, 0)).norm() < 1e-14);
  for (const auto* list : {&cubes, &octahedra, &hexagons})
    for (const Vec3& x : *list) CHECK(((x - low).head<2>().minCoeff() > 0 && (high - x).head<2>().minCoeff() > 0));
}
