// SPDX-License-Identifier: MIT
#include "geometry/region.hpp"
#include "tests/geometry/counting.hpp"

#include <limits>
#include <numbers>

using namespace tribo;
using std::numbers::pi;

namespace {

bool in(const RegionPtr& region, double x, double y, double z = 0.0) { return region->contains(Vec3(x, y, z)); }

}  // namespace

TEST_CASE("the measure of every plane shape agrees with counting", "[geometry]") {
  check_measure(*rectangle(0.1, 2.1, -1, 0.5), 2, 7, 0.01);
  check_measure(*oval(-1, 3, 0, 2), 2, 10, 0.01);
  check_measure(*oval(-1, 3, 0, 2, 0.3, 1.9), 2, 10, 0.01);
  check_measure(*oval(-1, 3, 0, 2, 1.9, 0.3), 2, 10, 0.01);
  check_measure(*arc(-1, 1, -1, 1, 0, 0, 0.1), 2, 13, 0.005);
  check_measure(*arc(-2, 2, -1, 1, 0, 0, 0.1), 2, 20, 0.005);
  check_measure(*polygon({{0, 0}, {3, 0}, {3, 2}, {1, 1}, {0, 2}}), 2, 12, 0.01);
}

TEST_CASE("plane measures are exact", "[geometry]") {
  CHECK(*rectangle(0, 2, 0, 3)->measure() == 6.0);
  CHECK(*oval(0, 4, 0, 2)->measure() == Approx(2 * pi).epsilon(1e-15));
  CHECK(*oval(-1, 1, -1, 1, 0.0, pi / 3)->measure() == Approx(pi / 6).epsilon(1e-14));
  CHECK(*oval(-1, 1, -1, 1, pi / 3, 0.0)->measure() == Approx(5 * pi / 6).epsilon(1e-14));
  CHECK(*oval(-2, 2, -1, 1, 0.0, pi / 2)->measure() == Approx(pi / 2).epsilon(1e-14));
  CHECK(*oval(-2, 2, -1, 1, -pi / 2, pi)->measure() == Approx(3 * pi / 2).epsilon(1e-14));
  // A quarter of the ring between radii 0.9 and 1.1
  CHECK(*arc(-1, 1, -1, 1, 0, pi / 2, 0.1)->measure() == Approx(pi / 4 * (1.21 - 0.81)).epsilon(1e-14));
  CHECK(*polygon({{0, 0}, {4, 0}, {0, 3}})->measure() == Approx(6).epsilon(1e-15));
}

TEST_CASE("the measure of every solid agrees with counting", "[geometry]") {
  const Vec3 low(-1, -0.5, 0), high(1, 0.5, 3);
  check_measure(*box(low, high), 3, 22, 0.03);
  check_measure(*ellipsoid(low, high), 3, 14, 0.03);
  for (const int axis : {0, 1, 2})
    for (const double taper : {1.0, 0.4, 0.0, -0.4, -1.0})
      check_measure(*cylinder(low, high, axis, taper), 3, 20, 0.03);
  check_measure(*torus(Vec3(-2, -2, -0.5), Vec3(2, 2, 0.5), 2, 0.3), 3, 34, 0.03);
  check_measure(*torus(Vec3(-0.5, -2, -3), Vec3(0.5, 2, 3), 0), 3, 50, 0.04);
  for (const int axis : {0, 1, 2}) check_measure(*shell(Vec3(-1, -1, -1), Vec3(1, 1, 1), axis, 0.8, 0.3), 3, 22, 0.02);
}

TEST_CASE("solid measures are exact", "[geometry]") {
  const Vec3 low(0, 0, 0), high(2, 2, 3);
  CHECK(*box(low, high)->measure() == 12.0);
  CHECK(*ellipsoid(low, Vec3(2, 2, 2))->measure() == Approx(4 * pi / 3).epsilon(1e-15));
  CHECK(*cylinder(low, high, 2)->measure() == Approx(3 * pi).epsilon(1e-15));
  CHECK(*cylinder(low, high, 2, 0.0)->measure() == Approx(pi).epsilon(1e-15));
  CHECK(*cylinder(low, high, 2, 0.5)->measure() == Approx(pi * 1.75).epsilon(1e-15));
  CHECK(*torus(Vec3(-2, -2, -0.5), Vec3(2, 2, 0.5), 2)->measure() == Approx(2 * pi * pi * 2 * 0.25).epsilon(1e-14));
  CHECK(*shell(Vec3(-1, -1, 0), Vec3(1, 1, 2), 2, 1.0, 0.2)->measure() == Approx(2 * pi * 0.2 * 2).epsilon(1e-14));
}

TEST_CASE("shapes are closed", "[geometry]") {
  CHECK(in(rectangle(0, 0.3, 0, 1), 0.1 + 0.2, 1));  // 0.1 + 0.2 > 0.3 in binary
  CHECK_FALSE(in(rectangle(0, 0.3, 0, 1), 0.3000001, 1));
  CHECK(in(oval(0, 2, 0, 2), 2, 1));
  CHECK(in(oval(0, 2, 0, 2), 1 + std::sqrt(0.5), 1 + std::sqrt(0.5)));
  CHECK_FALSE(in(oval(0, 2, 0, 2), 1.0 + 0.7072, 1.0 + 0.7072));
  CHECK(in(box(Vec3(0, 0, 0), Vec3(1, 1, 1)), 1, 1, 1));
  CHECK_FALSE(in(box(Vec3(0, 0, 0), Vec3(1, 1, 1)), 1, 1, 1.00001));
  CHECK(in(ellipsoid(Vec3(0, 0, 0), Vec3(2, 2, 2)), 1, 1, 2));
  CHECK(in(cylinder(Vec3(0, 0, 0), Vec3(2, 2, 2), 2, 0.0), 1, 1, 2));
  CHECK(in(cylinder(Vec3(0, 0, 0), Vec3(2, 2, 2), 2, 0.0), 2, 1, 0));
  CHECK(in(line(Vec3(0, 0, 0), Vec3(1, 0, 0), 0.1), 0.5, 0.1));
  CHECK(in(rectangle(1, 1, 0, 2), 1, 2));  // without width: selects nodes on a line
}

TEST_CASE("limits may be given in either order", "[geometry]") {
  CHECK(in(rectangle(2, 0, 3, 1), 1, 2));
  CHECK(*box(Vec3(1, 1, 1), Vec3(0, 0, 0))->measure() == 1.0);
}

TEST_CASE("a sector runs counterclockwise from start to end", "[geometry]") {
  const auto quarter = oval(-1, 1, -1, 1, 0.0, pi / 2);
  CHECK(in(quarter, 0.5, 0.5));
  CHECK(in(quarter, 0, 0));
  CHECK(in(quarter, 0.9, 0));
  CHECK(in(quarter, 0, 0.9));
  CHECK_FALSE(in(quarter, -0.5, 0.5));
  CHECK_FALSE(in(quarter, 0.5, -0.5));
  const auto rest = oval(-1, 1, -1, 1, pi / 2, 0.0);
  CHECK_FALSE(in(rest, 0.5, 0.5));
  CHECK(in(rest, -0.5, 0.5));
  CHECK(in(oval(-1, 1, -1, 1, 0.0, 2 * pi), -0.5, -0.5));
  const auto band = arc(-2, 2, -1, 1, 0, pi, 0.05);
  CHECK(in(band, 2.04, 0));
  CHECK(in(band, 0, 0.96));
  CHECK_FALSE(in(band, 0, 0.94));
  CHECK_FALSE(in(band, 0, -1));
}

TEST_CASE("the sign of the taper selects the narrow end of a cylinder", "[geometry]") {
  const Vec3 low(-1, -1, 0), high(1, 1, 2);
  CHECK(in(cylinder(low, high, 2, 0.5), 0.9, 0, 0.1));
  CHECK_FALSE(in(cylinder(low, high, 2, 0.5), 0.9, 0, 1.9));
  CHECK_FALSE(in(cylinder(low, high, 2, -0.5), 0.9, 0, 0.1));
  CHECK(in(cylinder(low, high, 2, -0.5), 0.9, 0, 1.9));
  CHECK(in(cylinder(low, high, 2, 0.5), 0.74, 0, 1));
  CHECK_FALSE(in(cylinder(low, high, 2, 0.5), 0.76, 0, 1));
}

TEST_CASE("a torus is centred on the ellipse of its box", "[geometry]") {
  const auto ring = torus(Vec3(-3, -2, -0.5), Vec3(3, 2, 0.5), 2, 0.2);
  CHECK(in(ring, 3.19, 0, 0));
  CHECK_FALSE(in(ring, 3.21, 0, 0));
  CHECK(in(ring, 0, -1.81, 0));
  CHECK_FALSE(in(ring, 0, -1.79, 0));
  CHECK(in(ring, 3, 0, 0.49));
  CHECK_FALSE(in(ring, 0, 0, 0));
  CHECK(ring->bounds().high[0] == Approx(3.2));
  CHECK(ring->bounds().low[1] == Approx(-2.2));
}

TEST_CASE("a polygon follows the even-odd rule", "[geometry]") {
  // A pentagram drawn in one go: its middle is crossed twice.
  std::vector<Vec<2>> star;
  for (int k = 0; k < 5; ++k) star.emplace_back(std::cos(4 * pi * k / 5), std::sin(4 * pi * k / 5));
  const auto pentagram = polygon(star);
  CHECK_FALSE(in(pentagram, 0, 0));
  CHECK(in(pentagram, 0.9, 0));
  CHECK_FALSE(pentagram->measure().has_value());
}

TEST_CASE("points on corners and edges are inside a polygon, and the test is correct at the height of its corners",
          "[geometry]") {
  const auto diamond = polygon({{1, 0}, {2, 1}, {1, 2}, {0, 1}});
  for (const auto& [x, y] : {std::pair(1.0, 0.0), {2.0, 1.0}, {1.0, 2.0}, {0.0, 1.0}, {1.5, 0.5}, {0.5, 1.5}})
    CHECK(in(diamond, x, y));
  CHECK(in(diamond, 1, 1));
  for (const double x : {-0.5, 2.5}) CHECK_FALSE(in(diamond, x, 1));  // level with corners left and right
  for (const double x : {0.5, 1.5})
    for (const double y : {0.0, 2.0}) CHECK_FALSE(in(diamond, x, y));  // level with the corners below and above
  const auto comb = polygon({{0, 0}, {4, 0}, {4, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  CHECK(in(comb, 3.5, 1));
  CHECK(in(comb, 1.5, 1));
  CHECK_FALSE(in(comb, 1.5, 1.0001));
  CHECK_FALSE(in(comb, 5, 1));
  CHECK_FALSE(in(comb, -1, 2));
  CHECK(in(comb, 2.5, 2));
  CHECK(*comb->measure() == Approx(6));
}

TEST_CASE("polygons that tile a square share it without gaps", "[geometry]") {
  const Vec<2> middle(0.37, 0.61);
  const std::vector<Vec<2>> corner{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<RegionPtr> tiles;
  double area = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    tiles.push_back(polygon({corner[k], corner[(k + 1) % 4], middle}));
    area += *tiles.back()->measure();
  }
  CHECK(area == Approx(1).epsilon(1e-15));
  for (int i = 0; i <= 100; ++i)
    for (int j = 0; j <= 100; ++j) {
      int owners = 0;
      for (const auto& tile : tiles) owners += in(tile, 0.01 * i, 0.01 * j);
      REQUIRE(owners >= 1);
    }
}

TEST_CASE("arguments that do not define a shape are refused", "[geometry]") {
  CHECK_THROWS_WITH(polygon({{0, 0}, {1, 0}}), "a polygon needs at least 3 corners, not 2");
  CHECK_THROWS_AS(oval(0, 0, 0, 1), std::runtime_error);
  CHECK_THROWS_AS(cylinder(Vec3(0, 0, 0), Vec3(1, 1, 1), 2, 1.5), std::runtime_error);
  CHECK_THROWS_AS(cylinder(Vec3(0, 0, 0), Vec3(1, 1, 1), 3, 1.0), std::runtime_error);
  CHECK_THROWS_AS(rectangle(0, std::numeric_limits<double>::quiet_NaN(), 0, 1), std::runtime_error);
  CHECK_THROWS_AS(line(Vec3(0, 0, 0), Vec3(1, 0, 0), -1), std::runtime_error);
  CHECK_THROWS_AS(unite({}), std::runtime_error);
}

TEST_CASE("booleans combine shapes as sets", "[geometry]") {
  const auto a = rectangle(0, 2, 0, 2), b = rectangle(1, 3, 1, 3);
  CHECK(in(unite({a, b}), 0.5, 0.5));
  CHECK(in(unite({a, b}), 2.5, 2.5));
  CHECK_FALSE(in(unite({a, b}), 2.5, 0.5));
  CHECK(in(intersect(a, b), 1.5, 1.5));
  CHECK_FALSE(in(intersect(a, b), 0.5, 0.5));
  CHECK(in(subtract(a, b), 0.5, 0.5));
  CHECK_FALSE(in(subtract(a, b), 1.5, 1.5));
  CHECK_FALSE(in(subtract(a, b), 1, 1));  // the surface of b is b's
  CHECK(in(subtract(b, a), 2.5, 2.5));
  CHECK(intersect(a, b)->bounds().low[0] == 1.0);
  CHECK(intersect(a, b)->bounds().high[1] == 2.0);
  CHECK(unite({a, b})->bounds().high[0] == 3.0);
  CHECK_FALSE(unite({a, b})->measure().has_value());
  CHECK(*unite({a, rectangle(5, 6, 0, 1)})->measure() == 5.0);
  CHECK(*subtract(a, rectangle(5, 6, 0, 1))->measure() == 4.0);
}

TEST_CASE("a shape is rotated right-handed and then shifted", "[geometry]") {
  const auto bar = move(rectangle(0, 2, 0, 0.5), Vec3::UnitZ(), pi / 2, Vec3::Zero(), Vec3(10, 0, 0));
  CHECK(in(bar, 9.75, 1.5));
  CHECK_FALSE(in(bar, 10.25, 1.5));
  CHECK_FALSE(in(bar, 11, 0.25));
  CHECK(bar->bounds().low[0] == Approx(9.5));
  CHECK(bar->bounds().high[1] == Approx(2));
  CHECK(*bar->measure() == 1.0);

  const auto about_corner = move(rectangle(0, 2, 0, 1), Vec3::UnitZ(), pi / 6, Vec3(2, 0, 0), Vec3::Zero());
  CHECK(in(about_corner, 2, 0));
  CHECK(in(about_corner, 2 - 2 * std::cos(pi / 6), -2 * std::sin(pi / 6)));
  check_measure(*about_corner, 2, 6, 0.01);

  const auto rod = move(box(Vec3(0, 0, 0), Vec3(1, 0.2, 0.2)), Vec3::UnitX(), pi / 2, Vec3::Zero(), Vec3::Zero());
  CHECK(in(rod, 0.5, -0.1, 0.1));
  CHECK_FALSE(in(rod, 0.5, 0.1, 0.1));
  const auto up = move(box(Vec3(0, 0, 0), Vec3(1, 0.2, 0.2)), Vec3::UnitY(), pi / 2, Vec3::Zero(), Vec3::Zero());
  CHECK(in(up, 0.1, 0.1, -0.5));
  check_measure(*move(ellipsoid(Vec3(-1, -2, -1), Vec3(1, 2, 1)), Vec3(1, 1, 1), 0.7, Vec3(0.2, 0, 0), Vec3(3, 2, 1)),
                3, 22, 0.03);
}
