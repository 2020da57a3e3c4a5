// SPDX-License-Identifier: MIT
#include "materials/material.hpp"
#include "particles/fill.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tribo;
using std::numbers::pi;

namespace {

// Only its density matters here.
class Weight final : public Material {
 public:
  explicit Weight(double density) : density_(density) {}
  void update(const MaterialPoints<2>&) const override {}
  void update(const MaterialPoints<3>&) const override {}
  double density() const override { return density_; }
  double wave_modulus() const override { return 1.0; }
  const std::vector<HistoryVariable>& history() const override {
    static const std::vector<HistoryVariable> none;
    return none;
  }

 private:
  double density_;
};

Model plane(int nx = 4, int ny = 4, double width = 4, double height = 4) {
  Model model;
  model.grid.low = {0, 0, 0};
  model.grid.high = {width, height, 0};
  model.grid.cells = {nx, ny, 1};
  for (const auto& [name, density] : {std::pair{"light", 2.0}, std::pair{"heavy", 10.0}}) {
    MaterialSpec& spec = model.materials.emplace_back();
    spec.name = name, spec.law = std::make_shared<Weight>(density);
  }
  return model;
}

Model solid(int n, double side) {
  Model model = plane();
  model.analysis = Analysis::solid;
  model.grid.high = {side, side, side};
  model.grid.cells = {n, n, n};
  return model;
}

Piece body(RegionPtr region, int material = 0) {
  Piece piece;
  piece.region = std::move(region);
  piece.material = material;
  return piece;
}

Expression function(const std::string& text) { return Expression(text, {}); }

double total(const Seeds& seeds, double Seed::*member) {
  double sum = 0.0;
  for (const auto& seed : seeds) sum += seed.*member;
  return sum;
}

long count(const Seeds& seeds, int piece) {
  return std::count_if(seeds.begin(), seeds.end(), [&](const Seed& s) { return s.piece == piece; });
}

}  // namespace

TEST_CASE("points lie at the fractions (2k-1)/(2n) of a cell, cell by cell and x fastest", "[fill]") {
  auto model = plane();
  model.grid.thickness = 3;
  model.pieces.push_back(body(rectangle(1, 3, 2, 3)));
  const auto seeds = place_points(model);
  REQUIRE(seeds.size() == 8);
  const std::vector<std::pair<double, double>> expected{{1.25, 2.25}, {1.75, 2.25}, {1.25, 2.75}, {1.75, 2.75},
                                                        {2.25, 2.25}, {2.75, 2.25}, {2.25, 2.75}, {2.75, 2.75}};
  for (std::size_t k = 0; k < 8; ++k) {
    CHECK(seeds[k].x[0] == expected[k].first);
    CHECK(seeds[k].x[1] == expected[k].second);
    CHECK(seeds[k].x[2] == 0.0);
    CHECK(seeds[k].volume == Approx(0.25 * 3));
    CHECK(seeds[k].mass == Approx(0.25 * 3 * 2));
    CHECK(seeds[k].half_size.isApprox(Vec3(0.25, 0.25, 1.5)));
    CHECK(seeds[k].F.isIdentity());
  }
}

TEST_CASE("points in space are ordered by cells, then by sub-cells", "[fill]") {
  auto model = solid(2, 2);
  model.pieces.push_back(body(box(Vec3(0, 0, 0), Vec3(2, 2, 2))));
  const auto seeds = place_points(model);
  REQUIRE(seeds.size() == 64);
  CHECK(seeds[0].x.isApprox(Vec3(0.25, 0.25, 0.25)));
  CHECK(seeds[1].x.isApprox(Vec3(0.75, 0.25, 0.25)));
  CHECK(seeds[2].x.isApprox(Vec3(0.25, 0.75, 0.25)));
  CHECK(seeds[4].x.isApprox(Vec3(0.25, 0.25, 0.75)));
  CHECK(seeds[8].x.isApprox(Vec3(1.25, 0.25, 0.25)));
  CHECK(seeds[16].x.isApprox(Vec3(0.25, 1.25, 0.25)));
  CHECK(seeds[32].x.isApprox(Vec3(0.25, 0.25, 1.25)));
  CHECK(total(seeds, &Seed::volume) == Approx(8));
  CHECK(total(seeds, &Seed::mass) == Approx(16));
}

TEST_CASE("a site belongs to the first piece or hole that contains it", "[fill]") {
  auto model = plane();
  model.pieces.push_back(body(rectangle(0, 1, 0, 1), -1));
  model.pieces.push_back(body(rectangle(0, 2, 0, 2), 0));
  model.pieces.push_back(body(rectangle(0, 4, 0, 4), 1));
  const auto seeds = place_points(model);
  CHECK(count(seeds, 0) == 0);
  CHECK(count(seeds, 1) == 12);
  CHECK(count(seeds, 2) == 48);
  CHECK(total(seeds, &Seed::volume) == Approx(15));
  CHECK(total(seeds, &Seed::mass) == Approx(3 * 2 + 12 * 10));
}

TEST_CASE("the first piece wins also over pieces with other points per cell", "[fill]") {
  auto model = plane();
  for (const int n : {1, 3})
    for (const bool own_lattice : {false, true}) {
      model.pieces.clear();
      model.pieces.push_back(body(rectangle(0, 2, 0, 4)));
      model.pieces.back().points_per_axis = {n, n, 1};
      model.pieces.push_back(body(rectangle(0, 4, 0, 4), 1));
      if (own_lattice) model.pieces.back().point_size = 0.5;
      const auto seeds = place_points(model);
      CHECK(count(seeds, 0) == 8 * n * n);
      CHECK(count(seeds, 1) == 32);
      CHECK(total(seeds, &Seed::volume) == Approx(16));
    }
}

TEST_CASE("a piece may have a lattice of its own", "[fill]") {
  auto model = plane();
  model.pieces.push_back(body(rectangle(0, 1, 0, 1), -1));
  model.pieces.push_back(body(rectangle(0.1, 2.1, 0.2, 1)));
  model.pieces.back().point_size = 0.4;
  auto seeds = place_points(model);
  // Centres 0.3 0.7 1.1 1.5 1.9 by 0.4 0.8; those below 1 are in the hole, which cuts the cells at 1.1.
  REQUIRE(seeds.size() == 6);
  CHECK(seeds[0].x.isApprox(Vec3(1.15, 0.4, 0)));
  CHECK(seeds[1].x.isApprox(Vec3(1.5, 0.4, 0)));
  CHECK(seeds[3].x.isApprox(Vec3(1.15, 0.8, 0)));
  CHECK(seeds[0].volume == Approx(0.12));
  CHECK(seeds[1].volume == Approx(0.16));
  CHECK(seeds[1].half_size.isApprox(Vec3(0.2, 0.2, 0.5)));
}

TEST_CASE("sites beyond a symmetry plane are left out", "[fill]") {
  auto model = plane();
  model.pieces.push_back(body(oval(-2, 2, -2, 2)));
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("cuts this body"));
  model.pieces.clear();
  model.grid.symmetry[0][0] = model.grid.symmetry[1][0] = 0.0;
  model.pieces.push_back(body(oval(-2, 2, -2, 2)));
  const auto seeds = place_points(model);
  for (const auto& seed : seeds) {
    CHECK(seed.x[0] > 0.0);
    CHECK(seed.x[1] > 0.0);
  }
  // The quarter disc: its arc is pi long, and what is counted wrongly lies within half a diagonal of it.
  CHECK(total(seeds, &Seed::volume) == Approx(pi).margin(pi * 0.5 * std::sqrt(0.5)));
  model.pieces.back().point_size = 0.05;
  const auto fine = place_points(model);
  CHECK(total(fine, &Seed::volume) == Approx(pi).margin(pi * 0.05 * std::sqrt(0.5)));
}

TEST_CASE("the number of points per cell can be chosen for the model and for a piece", "[fill]") {
  auto model = plane();
  model.points_per_cell = 9;
  model.pieces.push_back(body(rectangle(0, 1, 0, 1)));
  model.pieces.push_back(body(rectangle(1, 2, 0, 1)));
  model.pieces.back().points_per_axis = {5, 1, 0};
  const auto seeds = place_points(model);
  CHECK(count(seeds, 0) == 9);
  CHECK(count(seeds, 1) == 5);
  model.points_per_cell = 8;
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("8 points per cell is not a square"));
  auto space = solid(2, 2);
  space.points_per_cell = 27;
  space.pieces.push_back(body(box(Vec3(0, 0, 0), Vec3(1, 1, 1))));
  CHECK(place_points(space).size() == 27);
  space.points_per_cell = 9;
  CHECK_THROWS_WITH(place_points(space), Catch::Contains("9 points per cell is not a cube"));
}

TEST_CASE("the volume of an axisymmetric point is its area times its radius", "[fill]") {
  auto model = plane();
  model.analysis = Analysis::axisymmetric;
  model.grid.thickness = 7;  // without meaning here
  model.pieces.push_back(body(rectangle(1, 3, 0, 4)));
  const auto seeds = place_points(model);
  for (const auto& seed : seeds) CHECK(seed.volume == Approx(0.25 * seed.x[0]));
  CHECK(total(seeds, &Seed::volume) == Approx((9 - 1) / 2.0 * 4));  // of a hollow cylinder, per radian
  CHECK(total(seeds, &Seed::mass) == Approx(2 * 16));
  model.grid.low = {-1, 0, 0};
  model.pieces.push_back(body(rectangle(-1, 1, 0, 1)));
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("radii must be positive in an axisymmetric analysis"));
}

TEST_CASE("velocity and stress functions are evaluated where the point is", "[fill]") {
  auto model = plane();
  model.pieces.push_back(body(rectangle(0, 4, 0, 4)));
  auto& piece = model.pieces.back();
  piece.velocity = Vec3(1, 2, 0);
  piece.velocity_function[0] = function("-3*y");
  piece.stress.functions = {function("x"), function("2*y"), function("3"), function("x*y"), {}, {}};
  piece.temperature = 293;
  piece.angle = 0.5;
  for (const auto& seed : place_points(model)) {
    CHECK(seed.v.isApprox(Vec3(-3 * seed.x[1], 2, 0)));
    Mat3 expected;
    expected << seed.x[0], seed.x[0] * seed.x[1], 0, seed.x[0] * seed.x[1], 2 * seed.x[1], 0, 0, 0, 3;
    CHECK(seed.stress.isApprox(expected));
    CHECK(seed.temperature == 293.0);
    CHECK(seed.angle == 0.5);
  }
  auto space = solid(2, 2);
  space.pieces.push_back(body(box(Vec3(0, 0, 0), Vec3(1, 1, 1))));
  space.pieces.back().stress.functions[4] = function("y+2*z");
  space.pieces.back().stress.functions[5] = function("5*x");
  for (const auto& seed : place_points(space)) {
    CHECK(seed.stress(1, 2) == Approx(seed.x[1] + 2 * seed.x[2]));
    CHECK(seed.stress(2, 1) == seed.stress(1, 2));
    CHECK(seed.stress(0, 2) == Approx(5 * seed.x[0]));
    CHECK(seed.stress(2, 0) == seed.stress(0, 2));
    CHECK(seed.stress(0, 1) == 0.0);
  }
}

TEST_CASE("a deformed piece is found undeformed, moves with its F, and takes no sites", "[fill]") {
  auto model = plane();
  model.pieces.push_back(body(rectangle(0, 1, 0, 1)));
  InitialDeformation turn;  // by a quarter about the origin, then to the right by 2
  turn.shift = {function("2-y-x"), function("x-y"), std::nullopt};
  turn.F[0] = {function("0"), function("-1"), std::nullopt};
  turn.F[1] = {function("1"), function("0"), std::nullopt};
  model.pieces.back().deformation = turn;
  model.pieces.back().velocity_function[0] = function("x");
  model.pieces.push_back(body(rectangle(0, 1, 0, 1), 1));
  const auto seeds = place_points(model);
  REQUIRE(seeds.size() == 8);
  CHECK(seeds[0].x.isApprox(Vec3(1.75, 0.25, 0)));
  CHECK(seeds[1].x.isApprox(Vec3(1.75, 0.75, 0)));
  CHECK(seeds[1].v.isApprox(Vec3(0.75, 0, 0)));
  Mat3 quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  CHECK(seeds[0].F.isApprox(quarter));
  CHECK(seeds[4].x.isApprox(Vec3(0.25, 0.25, 0)));
  CHECK(seeds[4].piece == 1);

  model.pieces[0].deformation->F[0] = {function("0"), function("1"), std::nullopt};
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("is singular or inverts the body"));
  model.pieces[0].deformation = InitialDeformation{};
  model.pieces[0].deformation->shift[1] = function("-1");
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("moves a point out of the grid"));
}

TEST_CASE("single points are placed as given", "[fill]") {
  auto model = plane();
  PointSpec point;
  point.position = Vec3(1.3, 2.2, 0);
  point.velocity = Vec3(0, -1, 0);
  point.material = 1;
  model.points.push_back(point);
  point.half_size = Vec3(0.1, 0.2, 0.3);
  point.mass = 5;
  model.points.push_back(point);
  const auto seeds = place_points(model);
  REQUIRE(seeds.size() == 2);
  CHECK(seeds[0].x == point.position);
  CHECK(seeds[0].v == point.velocity);
  CHECK(seeds[0].piece == -1);
  CHECK(seeds[0].volume == Approx(0.25));
  CHECK(seeds[0].mass == Approx(2.5));
  CHECK(seeds[1].volume == Approx(0.2 * 0.4));
  CHECK(seeds[1].mass == 5.0);
  model.points[0].thickness = 3.0;
  CHECK(place_points(model)[0].volume == Approx(0.75));
  model.points[0].position[0] = 4.1;
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("lies outside the grid"));
}

TEST_CASE("a body without points is an error at its place in the file", "[fill]") {
  auto model = plane();
  model.pieces.push_back(body(rectangle(5, 6, 0, 1)));
  model.pieces.back().origin = {std::make_shared<const std::string>("deck.xml"), 12, 5};
  CHECK_THROWS_WITH(place_points(model),
                    Catch::Contains("deck.xml:12:5: error: this body lies outside the grid: it extends from (5, 0) to "
                                    "(6, 1), and the grid from (0, 0) to "));
  model.pieces.back().region = rectangle(0.3, 0.4, 0.3, 0.4);
  model.whole_particles = true;
  CHECK_THROWS_WITH(place_points(model),
                    Catch::Contains("this body gets no material point: it measures (0.1, 0.1), and points are "));
  model.whole_particles = false;
  model.pieces.back().region = rectangle(0, 1, 0, 1);
  model.pieces.back().velocity_function[0] = function("log(-x)");
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("has no finite value at t = 0, x = 0.25"));
  model.pieces.back() = body(rectangle(0, 1, 0, 1));
  model.materials[0].law = nullptr;
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("'light' is a contact law"));
}

TEST_CASE("the placed volume is compared with the exact one where that is known", "[fill]") {
  auto model = plane(40, 40);
  model.grid.symmetry[1][0] = 0.0;
  model.pieces.push_back(body(oval(1, 3, 1, 3)));
  model.pieces.push_back(body(rectangle(2, 4, 2, 4), 1));   // cut by the disc
  model.pieces.push_back(body(rectangle(0, 1, -1, 1), 1));  // cut by the grid
  model.pieces.push_back(body(rectangle(0, 1, 3, 4), 1));
  model.pieces.back().thickness = 2;
  const auto volumes = volume_error(model, place_points(model));
  REQUIRE(volumes.size() == 4);
  REQUIRE(volumes[0].exact);
  CHECK(*volumes[0].exact == Approx(pi));
  CHECK(volumes[0].placed == Approx(pi).margin(2 * pi * 0.05 * std::sqrt(0.5)));
  CHECK(*volumes[0].error() == Approx(volumes[0].placed / pi - 1));
  CHECK_FALSE(volumes[1].exact);
  CHECK_FALSE(volumes[2].exact);
  CHECK(*volumes[3].exact == Approx(2));
  CHECK(std::abs(*volumes[3].error()) < 1e-12);
  CHECK(volumes[3].points == 400);
  CHECK(volumes[3].piece == 3);
}

TEST_CASE("placing is the same every time and in both forms", "[fill]") {
  auto model = solid(6, 3);
  model.pieces.push_back(body(ellipsoid(Vec3(0, 0, 0), Vec3(3, 3, 3)), -1));
  model.pieces.push_back(body(box(Vec3(0, 0, 0), Vec3(3, 3, 3))));
  model.pieces.back().points_per_axis = {3, 2, 1};
  const auto seeds = place_points(model);
  std::size_t k = 0;
  place_points(model, [&](const Seed& seed) {
    REQUIRE(k < seeds.size());
    CHECK(seed.x == seeds[k++].x);
  });
  CHECK(k == seeds.size());
}

TEST_CASE("the volume of a ball of a million points is right to the size of a site", "[fill]") {
  auto model = solid(54, 1);
  model.pieces.push_back(body(ellipsoid(Vec3(0, 0, 0), Vec3(1, 1, 1))));
  double volume = 0.0;
  place_points(model, [&](const Seed& seed) { volume += seed.volume; });
  CHECK(volume == Approx(pi / 6).margin(pi / 108 * std::sqrt(3.0) / 2));
}
