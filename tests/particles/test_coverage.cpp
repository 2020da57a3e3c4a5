// SPDX-License-Identifier: MIT
/// Bodies that overlap, and bodies that an edge of the grid cuts.

#include "materials/material.hpp"
#include "particles/coverage.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tribo;

namespace {

// 10 x 10 cells from the origin.
Model flat_grid() {
  Model model;
  model.grid.low = {0, 0, 0}, model.grid.high = {10, 10, 0}, model.grid.cells = {10, 10, 1};
  return model;
}

Model with_pieces(std::initializer_list<std::pair<RegionPtr, int>> shapes) {
  Model model = flat_grid();
  for (const auto& [region, material] : shapes) {
    Piece piece;
    piece.region = region, piece.material = material;
    model.pieces.push_back(piece);
  }
  return model;
}

RegionPtr triangle(Vec<2> a, Vec<2> b, Vec<2> c) { return polygon({a, b, c}); }

}  // namespace

TEST_CASE("an edge of the grid that cuts a body is found with the share that is lost", "[coverage]") {
  const auto cut = [](const RegionPtr& region) { return edge_cuts(with_pieces({{region, 0}})); };
  CHECK(cut(rectangle(0, 10, 0, 10)).empty());
  CHECK(cut(oval(0, 10, 0, 10)).empty());
  CHECK(cut(rectangle(2, 10 + 1e-9, 2, 6)).empty());  // round-off
  const auto right = cut(rectangle(6, 16, 2, 6));
  REQUIRE(right.size() == 1);
  CHECK(right[0].axis == 0);
  CHECK(right[0].side == 1);
  CHECK(right[0].lost == Approx(0.6).margin(0.03));
  const auto below = cut(oval(2, 6, -2, 2));
  REQUIRE(below.size() == 1);
  CHECK(below[0].axis == 1);
  CHECK(below[0].side == 0);
  CHECK(below[0].lost == Approx(0.5).margin(0.03));
  REQUIRE(cut(rectangle(2, 6, 2, 10.01)).size() == 1);
  // Beside the body, and two pieces of which one lies outside
  CHECK(cut(unite({rectangle(1, 2, 1, 2), rectangle(8, 10, 1, 2)})).empty());
  REQUIRE(cut(unite({rectangle(1, 2, 1, 2), rectangle(12, 14, 1, 2)})).size() == 1);
}

TEST_CASE("symmetry planes, periodic edges, holes and earlier bodies may cut", "[coverage]") {
  Model model = with_pieces({{oval(-2, 2, 3, 7), 0}});
  CHECK(edge_cuts(model).size() == 1);
  model.grid.symmetry[0][0] = 0.0;
  CHECK(edge_cuts(model).empty());
  model.grid.symmetry[0][0].reset(), model.grid.symmetry[0][1] = 10.0;
  CHECK(edge_cuts(model).size() == 1);
  model.grid.periodic[0] = true;
  CHECK(edge_cuts(model).empty());
  CHECK(edge_cuts(with_pieces({{rectangle(-2, 0, 0, 10), -1}, {oval(-2, 2, 3, 7), 0}})).empty());
  Model axisymmetric = with_pieces({{oval(-2, 2, 3, 7), 0}});
  axisymmetric.analysis = Analysis::axisymmetric;
  CHECK(edge_cuts(axisymmetric).empty());
  Model solid = with_pieces({{box(Vec3(1, 1, 1), Vec3(3, 3, 4)), 0}});
  solid.analysis = Analysis::solid, solid.grid.high[2] = 10, solid.grid.cells[2] = 10;
  CHECK(edge_cuts(solid).empty());
  solid.grid.high[2] = 2, solid.grid.cells[2] = 2;
  REQUIRE(edge_cuts(solid).size() == 1);
  CHECK(edge_cuts(solid)[0].axis == 2);
  CHECK(edge_cuts(solid)[0].lost == Approx(2.0 / 3).margin(0.05));
}

TEST_CASE("bodies that overlap are found with their common area", "[coverage]") {
  const auto found = overlaps(with_pieces({{rectangle(1, 5, 1, 5), 0}, {rectangle(4, 8, 1, 5), 1}}));
  REQUIRE(found.size() == 1);
  CHECK(found[0].first == 0);
  CHECK(found[0].second == 1);
  CHECK(found[0].volume == Approx(4).epsilon(0.02));
  CHECK_FALSE(found[0].inside);
  const auto fibre = overlaps(with_pieces({{oval(4, 6, 4, 6), 0}, {rectangle(1, 9, 1, 9), 1}}));
  REQUIRE(fibre.size() == 1);
  CHECK(fibre[0].inside);
  CHECK(fibre[0].volume == Approx(std::numbers::pi).epsilon(0.02));
  // Two bodies of one material are one body, unless they move differently
  Model same = with_pieces({{rectangle(1, 5, 1, 5), 0}, {rectangle(4, 8, 1, 5), 0}});
  CHECK(overlaps(same).empty());
  same.pieces[1].velocity = Vec3::UnitX();
  CHECK(overlaps(same).size() == 1);
  // What a hole or an earlier body covers is not claimed
  CHECK(overlaps(with_pieces({{rectangle(4, 5, 0, 10), -1}, {rectangle(1, 5, 1, 5), 0}, {rectangle(4, 8, 1, 5), 1}}))
            .empty());
}

TEST_CASE("bodies whose slanted or curved faces touch do not overlap", "[coverage]") {
  // The halves of a square along a slanted line, and a disc in its hole
  CHECK(overlaps(with_pieces({{triangle({1, 1}, {9, 1}, {9, 6.7}), 0}, {triangle({1, 1}, {9, 6.7}, {1, 6.7}), 1}}))
            .empty());
  const double angle = 0.3;
  const auto turned = [&](double x0, double x1, double y0, double y1) {
    return move(rectangle(x0, x1, y0, y1), Vec3::UnitZ(), angle, Vec3(5, 5, 0), Vec3::Zero());
  };
  CHECK(overlaps(with_pieces({{turned(2, 8, 3, 5), 0}, {turned(2, 8, 5, 7), 1}})).empty());
  CHECK(overlaps(with_pieces({{turned(2, 8, 3, 5.5), 0}, {turned(2, 8, 5, 7), 1}})).size() == 1);
  CHECK(overlaps(with_pieces({{oval(3, 7, 3, 7), 0}, {subtract(rectangle(1, 9, 1, 9), oval(3, 7, 3, 7)), 1}})).empty());
  CHECK(overlaps(with_pieces({{oval(1, 5, 3, 7), 0}, {oval(5, 9, 3, 7), 1}})).empty());
}

TEST_CASE("a body that the grid cuts is an error with the place of the body", "[coverage]") {
  Model model = with_pieces({{rectangle(6, 16, 2, 6), 0}});
  const auto text = text_of(edge_cuts(model).at(0), model);
  CHECK(text.find("the edge of the grid at xmax = 10 cuts this body: 60 % of it lies outside") != std::string::npos);
}

TEST_CASE("a body that has parts beyond a symmetry plane is known", "[particles]") {
  const auto part = [](double low, double high, double x, double radius) {
    Model model = with_pieces({{oval(x - radius, x + radius, 3, 3 + 2 * radius), 0}});
    model.grid.symmetry[0] = {low, high};
    return part_beyond_plane(model, 0);
  };
  const double low = 0.0, high = 10.0;
  CHECK(!part(low, high, 5, 2));
  CHECK(!part(low, high, 0, 2));  // the plane is the edge of the grid
  CHECK(part(low, 6, 5, 2) == "this body has parts beyond the symmetry plane at xmax = 6, up to x = 7");
  CHECK(part(4, high, 5, 2) == "this body has parts beyond the symmetry plane at xmin = 4, up to x = 3");
  CHECK(!part(low, 7, 5, 2));
}
