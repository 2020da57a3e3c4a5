// SPDX-License-Identifier: MIT
/// Cells of particles that the surface of a shape cuts.

#include <catch2/catch.hpp>

#include "materials/material.hpp"
#include "particles/convex_cell.hpp"
#include "particles/cut_cell.hpp"
#include "particles/fill.hpp"

#include <numbers>
#include <random>

using namespace tribo;

namespace {

std::shared_ptr<const Material> law() {
  Statement statement;
  for (const auto& [name, value] : {std::pair{"rho", "2"}, {"E", "1"}, {"nu", "0"}}) {
    Statement child;
    child.name = name, child.text = value;
    statement.children.push_back(child);
  }
  Problems problems;
  return materials().find("LinearElastic")->make(statement, {}, Units{}, problems);
}

Model model_of(int dimension, std::vector<RegionPtr> shapes, double size = 16, int cells = 16) {
  Model model;
  model.analysis = dimension == 2 ? Analysis::plane_strain : Analysis::solid;
  for (std::size_t k = 0; k < 3; ++k) model.grid.high[k] = size, model.grid.cells[k] = cells;
  model.materials.emplace_back();
  model.materials.back().name = "matter";
  model.materials.back().law = law();
  for (auto& shape : shapes) {
    Piece piece;
    piece.region = std::move(shape);
    piece.material = 0;
    model.pieces.push_back(std::move(piece));
  }
  return model;
}

double volume_of(const Seeds& seeds) {
  double sum = 0.0;
  for (const Seed& s : seeds) sum += s.volume;
  return sum;
}

/// Largest value of x . n over the domains of all particles.
double reach(const Seeds& seeds, const Vec3& n) {
  double most = -1e300;
  for (const Seed& s : seeds) {
    const Mat3 axes = s.half_axes.value_or(Mat3(s.half_size.asDiagonal()));
    double at = s.x.dot(n);
    for (int k = 0; k < 3; ++k) at += std::abs(axes.col(k).dot(n));
    most = std::max(most, at);
  }
  return most;
}

double smallest_fraction(const Seeds& seeds, double whole) {
  double least = 1e300;
  for (const Seed& s : seeds) least = std::min(least, s.volume / whole);
  return least;
}

}  // namespace

TEST_CASE("a box cut by planes has the volume, the centroid and the faces of the rest", "[cut_cells]") {
  ConvexCell cell(Vec3(0, 0, 0), Vec3(2, 1, 1));
  CHECK(cell.volume() == Approx(2));
  CHECK(cell.centroid().isApprox(Vec3(1, 0.5, 0.5)));
  cell.cut(Vec3(1, 1, 0).normalized(), 2 / std::sqrt(2), 0);  // x + y <= 2 leaves a trapezium
  CHECK(cell.volume() == Approx(1.5));
  CHECK(cell.centroid().isApprox(Vec3(7.0 / 9, 4.0 / 9, 0.5)));
  const CellFace& face = cell.faces().back();
  CHECK(face.plane == ConvexCell::first_cut);
  CHECK(face.vector_area().isApprox(Vec3(1, 1, 0)));
  CHECK(face.centre().isApprox(Vec3(1.5, 0.5, 0.5)));
  CHECK(face.covariance().trace() == Approx((2 + 1) / 12.0));
  cell.cut(Vec3(0, 0, 1), 5, 1);  // beyond the cell
  CHECK(cell.volume() == Approx(1.5));
  cell.cut(Vec3(0, 0, 1), -1, 2);  // nothing is left
  CHECK(cell.volume() == 0.0);

  ConvexCell cube(Vec3(0, 0, 0), Vec3(1, 1, 1));
  cube.cut(Vec3(1, 1, 1).normalized(), 1 / std::sqrt(3), 0);
  CHECK(cube.volume() == Approx(1.0 / 6));
  CHECK(cube.centroid().isApprox(Vec3::Constant(0.25)));
  CHECK(cube.faces().back().vector_area().norm() == Approx(std::sqrt(3) / 2));
}

TEST_CASE("a plane cuts a cell exactly, in any direction", "[cut_cells]") {
  const bool flat = GENERATE(true, false);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Vec3 n(number(random), number(random), flat ? 0.0 : number(random));
    n.normalize();
    const double at = 0.5 * number(random);
    const Vec3 low(-0.5, -0.5, -0.5), high(0.5, 0.5, 0.5);
    ConvexCell exact(low, high);
    exact.cut(n, at, 0);
    const auto part = cut_cell([&](const Vec3& x) { return x.dot(n) <= at; }, low, high, flat);
    if (!part) {
      CHECK(exact.volume() < 0.05);
      continue;
    }
    CHECK(part->volume == Approx(exact.volume()).margin(1e-9));
    CHECK((part->centroid - exact.centroid()).norm() < 1e-9);
    if (part->facets.empty()) continue;
    CHECK((part->facets[0].normal - n).norm() < 1e-9);
    CHECK(std::abs(part->facets[0].centre.dot(n) - at) < 1e-9);
    // The represented domain ends at the plane.
    const Mat3 axes = part->half_axes(flat);
    double ends = part->centroid.dot(n);
    for (int k = 0; k < 3; ++k) ends += std::abs(axes.col(k).dot(n));
    if (at - part->centroid.dot(n) > 0.03) CHECK(ends == Approx(at).margin(1e-9));
  }
}

TEST_CASE("outer and inner edges of a shape cut a cell exactly", "[cut_cells]") {
  const Vec3 low(0, 0, -0.5), high(1, 1, 0.5);
  const double slope = GENERATE(0.0, 0.3);
  const auto right_of = [=](const Vec3& x) { return x[0] >= 0.4 + slope * (x[1] - 0.4); };
  const auto above = [](const Vec3& x) { return x[1] >= 0.4; };
  const auto outer = cut_cell([&](const Vec3& x) { return right_of(x) && above(x); }, low, high, true);
  REQUIRE(outer);
  const double quadrant = 0.6 * (0.6 - slope * 0.3);
  CHECK(outer->volume == Approx(quadrant).epsilon(1e-8));
  REQUIRE(outer->facets.size() == 2);
  // The corner of the domain is the corner of the shape.
  const Mat3 axes = outer->half_axes(true);
  double nearest = 1e300;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec3 x = outer->centroid + (corner & 1 ? 1.0 : -1.0) * axes.col(0) + (corner & 2 ? 1.0 : -1.0) * axes.col(1);
    nearest = std::min(nearest, (x - Vec3(0.4, 0.4, 0)).norm());
  }
  CHECK(nearest < 1e-8);
  const auto inner = cut_cell([&](const Vec3& x) { return !(right_of(x) && above(x)); }, low, high, true);
  REQUIRE(inner);
  CHECK(inner->volume == Approx(1 - quadrant).epsilon(1e-8));
  CHECK(inner->facets.size() == 2);
}

TEST_CASE("bodies have the volume of their shapes and no tiny particles", "[cut_cells]") {
  struct Shape {
    int dimension;
    RegionPtr region;
    double volume;
  };
  const double c = std::cos(0.4), s = std::sin(0.4);
  const auto turned = [&](double x, double y) { return Vec<2>(8 + c * x - s * y, 8 + s * x + c * y); };
  const std::vector<Shape> shapes{
      {2, rectangle(3.1, 9.77, 2.6, 7.3), 6.67 * 4.7},
      {2, oval(3.3, 11.3, 4.1, 12.1), std::numbers::pi * 16},
      {2, oval(2.2, 13.8, 5.1, 9.7), std::numbers::pi * 5.8 * 2.3},
      {2, polygon({turned(-4, -3), turned(4, -3), turned(4, 3), turned(-4, 3)}), 48},
      {2, polygon({{2.2, 3.1}, {12.7, 3.9}, {7.4, 12.3}}), 0.5 * (10.5 * 9.2 - 5.2 * 0.8)},
      {3, ellipsoid(Vec3(3.3, 3.3, 3.3), Vec3(12.3, 12.3, 12.3)), std::numbers::pi / 6 * 729},
      {3, cylinder(Vec3(4.2, 4.2, 3.3), Vec3(11.2, 11.2, 9.7), 2), std::numbers::pi / 4 * 49 * 6.4},
      {3, box(Vec3(3.1, 2.9, 4.4), Vec3(9.35, 8.2, 9.9)), 6.25 * 5.3 * 5.5},
      {3, move(box(Vec3(-3, -2.5, -3), Vec3(3, 2.5, 3)), Vec3(1, 2, 3).normalized(), 0.7, Vec3::Zero(), Vec3(8, 8, 8)),
       180}};
  for (const Shape& shape : shapes) {
    const auto seeds = place_points(model_of(shape.dimension, {shape.region}));
    CAPTURE(shape.dimension, shape.volume);
    CHECK(volume_of(seeds) == Approx(shape.volume).epsilon(1e-10));
    CHECK(smallest_fraction(seeds, shape.dimension == 2 ? 0.25 : 0.125) > 0.25);
    for (const Seed& seed : seeds) {
      CHECK(seed.mass == Approx(2 * seed.volume));
      if (seed.half_axes) CHECK(seed.half_axes->determinant() > 0);
    }
  }
}

TEST_CASE("the domains end where the shape ends, in every direction", "[cut_cells]") {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto turned = [&](double x, double y) { return Vec<2>(8.1 + c * x - s * y, 7.8 + s * x + c * y); };
  const auto slanted =
      place_points(model_of(2, {polygon({turned(-4.1, -3), turned(4.1, -3), turned(4.1, 3), turned(-4.1, 3)})}));
  const Vec3 u(c, s, 0), v(-s, c, 0), middle(8.1, 7.8, 0);
  CHECK(reach(slanted, u) == Approx(middle.dot(u) + 4.1).margin(1e-9));
  CHECK(reach(slanted, -u) == Approx(-middle.dot(u) + 4.1).margin(1e-9));
  CHECK(reach(slanted, v) == Approx(middle.dot(v) + 3).margin(1e-9));
  CHECK(reach(slanted, -v) == Approx(-middle.dot(v) + 3).margin(1e-9));

  // Of a circle of radius R, sides of length a stick out by a^2/(8 R), or lie behind it by as much.
  const double radius = 6.2;
  const auto disc = place_points(model_of(2, {oval(8.2 - radius, 8.2 + radius, 8 - radius, 8 + radius)}));
  for (int k = 0; k < 360; ++k) {
    const Vec3 n(std::cos(k * std::numbers::pi / 180), std::sin(k * std::numbers::pi / 180), 0);
    CHECK(std::abs(reach(disc, n) - n.dot(Vec3(8.2, 8, 0)) - radius) < 1.5 * 0.7 * 0.7 / (8 * radius));
  }
  // The corners of a side that belongs to two joined cells of size 1/2 are at most 0.9 from its middle.
  const auto ball = place_points(model_of(3, {ellipsoid(Vec3::Constant(2.1), Vec3::Constant(14.1))}));
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  for (int k = 0; k < 300; ++k) {
    const Vec3 n = Vec3(number(random), number(random), number(random)).normalized();
    CHECK(std::abs(reach(ball, n) - n.sum() * 8.1 - 6) < 0.9 * 0.9 / (2 * 6));
  }
}

TEST_CASE("two bodies with a common slanted face fill the space without overlap", "[cut_cells]") {
  const auto below = polygon({{2, 2}, {14, 2}, {14, 8.3}, {2, 5.1}}), all = rectangle(2, 14, 2, 14);
  auto model = model_of(2, {below, all});
  const auto seeds = place_points(model);
  CHECK(volume_of(seeds) == Approx(144).epsilon(1e-8));
  std::vector<Seed> first, second;
  for (const Seed& s : seeds) (s.piece == 0 ? first : second).push_back(s);
  CHECK(volume_of(first) == Approx(12 * (3.1 + 6.3) / 2).epsilon(1e-8));
  const Vec3 n = Vec3(-3.2, 12, 0).normalized();
  const double face = Vec3(2, 5.1, 0).dot(n);
  CHECK(reach(first, n) == Approx(face).margin(1e-8));
  CHECK(reach(second, -n) == Approx(-face).margin(1e-8));
}

TEST_CASE("faces on the lines of particles cut nothing", "[cut_cells]") {
  const auto seeds = place_points(model_of(3, {box(Vec3(2, 3, 4), Vec3(5, 6.5, 7))}));
  CHECK(seeds.size() == 6 * 7 * 6);
  for (const Seed& s : seeds) CHECK(!s.half_axes);
}

TEST_CASE("with one particle per cell no box is larger than a cell", "[cut_cells]") {
  auto model = model_of(2, {oval(3.3, 11.3, 4.1, 12.1)});
  model.points_per_cell = 1;
  double largest = 0.0;
  for (const Seed& s : place_points(model)) {
    CHECK(s.half_size.head<2>().maxCoeff() <= 0.5);
    largest = std::max(largest, s.volume);
  }
  CHECK(largest > 1.05);  // of a joined cell
}

TEST_CASE("whole particles can be asked for", "[cut_cells]") {
  auto model = model_of(2, {oval(3.3, 11.3, 4.1, 12.1)});
  model.whole_particles = true;
  for (const Seed& s : place_points(model)) CHECK(s.volume == Approx(0.25));
}

TEST_CASE("a plate thinner than a particle keeps its volume", "[cut_cells]") {
  const auto seeds = place_points(model_of(2, {rectangle(2, 10, 5.3, 5.42)}));
  CHECK(volume_of(seeds) == Approx(8 * 0.12).epsilon(1e-8));
}
