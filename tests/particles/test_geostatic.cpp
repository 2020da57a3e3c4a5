// SPDX-License-Identifier: MIT
#include "material_point.hpp"
#include "particles/fill.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using test::make_material;

namespace {

std::shared_ptr<const Material> soil(const char* density) {
  return make_material("LinearElastic", {{"rho", density}, {"E", "1e6"}, {"nu", "0.3"}});
}

// 4 x 4 cells, three layers of which the uppermost ends half way.
Model ground() {
  Model model;
  model.grid.low = {0, 0, 0}, model.grid.high = {4, 4, 0}, model.grid.cells = {4, 4, 1};
  for (const auto& [name, density] : {std::pair{"light", "2"}, std::pair{"heavy", "10"}}) {
    MaterialSpec& spec = model.materials.emplace_back();
    spec.name = name, spec.law = soil(density);
  }
  model.body_force.gravity = {0, -10, 0};
  const auto add = [&](RegionPtr region, int material) {
    Piece piece;
    piece.region = std::move(region), piece.material = material, piece.K0 = 0.5;
    model.pieces.push_back(piece);
  };
  add(rectangle(0, 4, 0, 2), 1);
  add(rectangle(0, 4, 2, 3), 0);
  add(rectangle(2, 4, 3, 4), 0);
  return model;
}

Mat3 stress_at(const Seeds& seeds, double x, double y) {
  for (const auto& s : seeds)
    if ((s.x.head<2>() - Vec<2>(x, y)).norm() < 1e-9) return s.stress;
  throw std::runtime_error("no seed there");
}

}  // namespace

TEST_CASE("the geostatic stress is the weight of the material above, up to the actual surface", "[geostatic]") {
  const auto seeds = place_points(ground());
  // 1 of light soil over 1.75 of heavy one; under the higher half 2 of light soil
  for (const auto& [x, y, weight] : {std::tuple{0.25, 0.25, 20 + 175.0},
                                     {1.75, 1.75, 20 + 25.0},
                                     {0.75, 2.75, 5.0},
                                     {2.25, 0.25, 40 + 175.0},
                                     {3.75, 3.75, 5.0},
                                     {3.25, 2.25, 35.0}}) {
    CHECK(stress_at(seeds, x, y)(1, 1) == Approx(-weight).epsilon(1e-13));
    CHECK(stress_at(seeds, x, y)(0, 0) == Approx(-0.5 * weight).epsilon(1e-13));
    CHECK(stress_at(seeds, x, y)(2, 2) == Approx(-0.5 * weight).epsilon(1e-13));
    CHECK(stress_at(seeds, x, y)(0, 1) == 0.0);
  }
}

TEST_CASE("gravity may have any axis direction, and a body without K0 has weight but no initial stress",
          "[geostatic]") {
  auto model = ground();
  model.body_force.gravity = {10, 0, 0};
  model.pieces[1].K0.reset();
  const auto seeds = place_points(model);
  CHECK(stress_at(seeds, 3.75, 0.25)(0, 0) == Approx(-375.0));  // what is "above" lies at lower x
  CHECK(stress_at(seeds, 3.75, 0.25)(1, 1) == Approx(-187.5));
  CHECK(stress_at(seeds, 2.25, 3.25)(0, 0) == Approx(-5.0));
  CHECK(stress_at(seeds, 2.25, 2.25).norm() == 0.0);
}

TEST_CASE("the weight of points of other sizes and of deformed bodies is that of their domains", "[geostatic]") {
  auto model = ground();
  model.pieces[1].points_per_axis = {3, 3, 1};
  InitialDeformation squeeze;
  squeeze.F[1][1] = Expression("0.5", {});
  model.pieces[2].deformation = squeeze;
  const auto seeds = place_points(model);
  CHECK(stress_at(seeds, 0.25, 0.25)(1, 1) == Approx(-195.0));
  // the upper layer keeps its mass: its points stand as they did, half as high and twice as dense
  CHECK(stress_at(seeds, 3.25, 0.25)(1, 1) == Approx(-215.0));
}

TEST_CASE("a geostatic stress needs gravity along an axis and a law that keeps initial stress", "[geostatic]") {
  auto model = ground();
  model.body_force.gravity = {0, 0, 0};
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("needs gravity along an axis"));
  model.body_force.gravity = {1, -10, 0};
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("needs gravity along an axis"));
  model = ground();
  model.materials[0].law = make_material("NeoHookean", {{"rho", "1"}, {"E", "1e6"}, {"nu", "0.3"}});
  CHECK_THROWS_WITH(place_points(model), Catch::Contains("'light' keeps no initial stress"));
}

TEST_CASE("laws that keep an initial stress", "[materials]") {
  CHECK(keeps_stress(*soil("1")));
  CHECK(keeps_stress(
      *make_material("MohrCoulomb", {{"rho", "1"}, {"E", "1"}, {"nu", "0.3"}, {"cohesion", "1"}, {"friction", "30"}})));
  CHECK_FALSE(keeps_stress(*make_material("NeoHookean", {{"rho", "1"}, {"E", "1"}, {"nu", "0.3"}})));
  CHECK_FALSE(keeps_stress(*make_material("TaitLiquid", {{"rho", "1"}, {"K", "1"}, {"viscosity", "1"}})));
}

TEST_CASE("stress from a table of points adds to the weight of the ground", "[geostatic]") {
  auto model = ground();
  const auto table = std::make_shared<const ScatteredField>(
      std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}},
      std::vector<ScatteredField::Values>{
          {1, 0, 0, 7, 0, 0}, {5, 0, 0, 7, 0, 0}, {1, 0, 0, 15, 0, 0}, {5, 0, 0, 15, 0, 0}},
      2);
  const double before = stress_at(place_points(model), 1.75, 1.75)(1, 1);
  model.pieces[0].stress.points = table;
  const Mat3 s = stress_at(place_points(model), 1.75, 1.75);
  CHECK(s(1, 1) == Approx(before));
  CHECK(s(0, 0) == Approx(0.5 * before + 1 + 1.75));
  CHECK(s(0, 1) == Approx(7 + 2 * 1.75));
  CHECK(s(1, 0) == s(0, 1));
  CHECK(stress_at(place_points(model), 0.75, 2.75)(0, 1) == 0.0);
}
