// SPDX-License-Identifier: MIT
/// Distance and direction of convex blocks.

#include "blocks/placed_cases.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace tribo;
using namespace tribo::test;

namespace {

/// By all faces and all pairs of edges.
double largest_gap(const Placed& a, const Placed& b, bool edges) {
  double best = -std::numeric_limits<double>::infinity();
  const auto along = [&](Vec3 n) {
    if (n.norm() < 1e-9) return;
    n.normalize();
    double a_low = 1e300, a_high = -1e300, b_low = 1e300, b_high = -1e300;
    for (const Vec3& x : a.block.corners) a_low = std::min(a_low, n.dot(x)), a_high = std::max(a_high, n.dot(x));
    for (const Vec3& x : b.block.corners) b_low = std::min(b_low, n.dot(x)), b_high = std::max(b_high, n.dot(x));
    best = std::max({best, b_low - a_high, a_low - b_high});
  };
  for (const Placed* p : {&a, &b})
    for (const Vec3& n : p->block.normals) along(n);
  if (edges)
    for (const BlockEdge& e : a.edges)
      for (const BlockEdge& f : b.edges)
        along((a.block.corners[e.to] - a.block.corners[e.from]).cross(b.block.corners[f.to] - b.block.corners[f.from]));
  return best;
}

}  // namespace

TEST_CASE("a cube has twelve edges with the faces beside them", "[blocks]") {
  const Placed c(cube(1, false), Vec3::Zero(), Mat3::Identity(), false);
  REQUIRE(c.edges.size() == 12);
  for (const BlockEdge& e : c.edges) {
    const Vec3 along = c.block.corners[e.to] - c.block.corners[e.from];
    CHECK(c.block.normals[e.left].cross(c.block.normals[e.right]).dot(along) == Approx(2));
  }
}

TEST_CASE("blocks are apart along faces, edges and corners", "[blocks]") {
  for (const bool plane : {true, false}) {
    const Placed a(cube(0.5, plane), Vec3::Zero(), Mat3::Identity(), plane),
        b(cube(0.5, plane), Vec3(0.9, 0.2, 0), Mat3::Identity(), plane);
    const BlockGap s = separation(a.block, b.block, plane, 1e300);
    CHECK(s.gap == Approx(-0.1));
    CHECK((s.n - Vec3::UnitX()).norm() < 1e-14);
    CHECK((separation(b.block, a.block, plane, 1e300).n + Vec3::UnitX()).norm() < 1e-14);
    const Placed corner(cube(0.5, plane), Vec3(0.5 + std::sqrt(0.5) + 0.25, 0, 0), turned(M_PI / 4, Vec3::UnitZ()),
                        plane);
    CHECK(separation(a.block, corner.block, plane, 1e300).gap == Approx(0.25));
  }
  // two crossed edges
  const Placed a(cube(0.5, false), Vec3::Zero(), turned(M_PI / 4, Vec3::UnitZ()), false),
      b(cube(0.5, false), Vec3(std::sqrt(2) - 0.01, 0, 0), turned(M_PI / 4, Vec3::UnitY()), false);
  const BlockGap s = separation(a.block, b.block, false, 1e300);
  CHECK(s.gap == Approx(-0.01));
  CHECK((s.n - Vec3::UnitX()).norm() < 1e-12);
}

TEST_CASE("the largest separation is found among all faces and edges", "[blocks]") {
  std::mt19937 random(5);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  const auto vector = [&] { return Vec3(number(), number(), number()); };
  int by_edges = 0;
  for (int k = 0; k < 400; ++k) {
    const Placed a(brick_block({-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2}, false), Vec3::Zero(),
                   turned(6 * number(), vector()), false),
        b(brick_block({-0.4, -0.4, -0.1}, {0.4, 0.4, 0.1}, false), 1.6 * vector(), turned(6 * number(), vector()),
          false);
    const double found = separation(a.block, b.block, false, 1e300).gap, faces = largest_gap(a, b, false),
                 all = largest_gap(a, b, true);
    INFO("pair " << k);
    CHECK(found == Approx(all < 0 && all <= 0.95 * faces ? faces : all).margin(1e-12));
    by_edges += all > faces ? 1 : 0;
    CHECK((separation(a.block, b.block, false, 0.1).gap > 0.1) == (found > 0.1));
  }
  CHECK(by_edges > 20);
}
