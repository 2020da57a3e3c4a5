// SPDX-License-Identifier: MIT
#include "solver/cracks/line_points.hpp"
#include "solver/state/crack.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tribo;

namespace {

using Numbers = std::vector<std::uint32_t>;

std::vector<Vec3> straight(const Vec3& from, const Vec3& to, std::size_t segments) {
  std::vector<Vec3> out;
  for (std::size_t k = 0; k <= segments; ++k)
    out.push_back(from + static_cast<double>(k) / static_cast<double>(segments) * (to - from));
  return out;
}

}  // namespace

TEST_CASE("a straight line keeps a point every quarter of a cell, and both ends", "[cracks]") {
  const double cell = 2.0;
  const auto line = straight({1, 2, 0}, {7, 10, 0}, 1000);  // 0.01 long each, 0.005 cells
  const Numbers kept = resolved_points(line, cell);
  REQUIRE(kept.size() == 21);
  for (std::size_t k = 0; k < kept.size(); ++k) CHECK(kept[k] == 50 * k);
  const Numbers uneven = resolved_points(straight({0, 0, 0}, {2.6, 0, 0}, 997), cell);  // 5.2 quarters of a cell
  REQUIRE(uneven.size() == 7);
  for (std::size_t k = 1; k < uneven.size(); ++k) CHECK(std::abs(uneven[k] - uneven[k - 1] - 997.0 / 6) <= 1.5);
  const Numbers coarse = resolved_points(straight({0, 0, 0}, {8, 0, 0}, 10), cell);
  CHECK(coarse.size() == 11);  // segments longer than a quarter of a cell stay
  CHECK(resolved_points(straight({0, 0, 0}, {0.3, 0, 0}, 1), cell) == Numbers{0, 1});
}

TEST_CASE("corners, teeth and folds of a line are kept", "[cracks]") {
  auto line = straight({0, 0, 0}, {0.1, 0, 0}, 10);
  for (const Vec3& x : straight({0.1, 0.01, 0}, {0.1, 0.1, 0}, 9)) line.push_back(x);
  CHECK(resolved_points(line, 1.0) == Numbers{0, 10, 20});
  std::vector<Vec3> teeth;
  for (int k = 0; k < 20; ++k) teeth.emplace_back(0.01 * k, k % 2 ? 2e-3 : 0.0, 0.0);
  CHECK(resolved_points(teeth, 1.0).size() == teeth.size());
  for (Vec3& x : teeth) x[1] *= 0.5;  // below the tolerance
  CHECK(resolved_points(teeth, 1.0) == Numbers{0, 19});
  const std::vector<Vec3> fold{{0, 0, 0}, {0.1, 0, 0}, {0.05, 0, 0}};
  CHECK(resolved_points(fold, 1.0) == Numbers{0, 1, 2});
}

TEST_CASE("a finely divided arc stays within a thousandth of a cell", "[cracks]") {
  for (const double radius : {0.5, 5.0, 50.0}) {
    std::vector<Vec3> arc;
    constexpr int segments = 20000;
    for (int k = 0; k <= segments; ++k) {
      const double angle = std::numbers::pi * k / segments;
      arc.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    const Numbers kept = resolved_points(arc, 1.0);
    CHECK(kept.size() < arc.size() / 2);
    double farthest = 0.0;
    for (std::size_t k = 1; k < kept.size(); ++k) {
      const Vec3 &a = arc[kept[k - 1]], along = (arc[kept[k]] - a).normalized();
      CHECK((arc[kept[k]] - a).norm() < 0.25 * (1 + 2e-9));
      for (std::uint32_t i = kept[k - 1]; i <= kept[k]; ++i)
        farthest = std::max(farthest, (arc[i] - a - (arc[i] - a).dot(along) * along).norm());
    }
    CHECK(farthest < 1.0001e-3);
    CHECK(kept.size() < 2 + std::numbers::pi * radius * std::max(8.0, 1 / std::sqrt(8 * radius * 0.25e-3)));
    for (std::size_t k = 0; k < kept.size(); ++k)  // nearly the same from both ends
      CHECK(std::abs(static_cast<double>(kept[k] + kept[kept.size() - 1 - k]) - segments) <= 1e-3 * segments);
  }
}

TEST_CASE("the direction of a crack at a tip does not depend on short pieces", "[cracks]") {
  Crack<2> crack;
  for (int k = 0; k <= 20; ++k) crack.add_point(crack.x.size(), {0.1 * k, 0.05 * k});
  for (std::uint32_t k = 1; k <= 20; ++k) crack.pieces.push_back({k - 1, k});
  crack.main_points = 21, crack.main_pieces = 20;
  crack.x[19] += Vec<2>(0.0, 0.04), crack.x[1] += Vec<2>(0.0, 0.04);
  CrackTip first, last;
  first.end = 0, first.point = 0, first.previous = 1;
  last.end = 1, last.point = 20, last.previous = 19;
  const Vec<2> along = Vec<2>(2, 1).normalized();
  CHECK((crack.direction_at(last, 0.5) - along).norm() < 1e-12);
  CHECK((crack.direction_at(first, 0.5) + along).norm() < 1e-12);
  CHECK((crack.direction_at(last, 0.01) - Vec<2>(0.1, 0.01).normalized()).norm() < 1e-12);
  CHECK((crack.direction_at(last, 100.0) - along).norm() < 1e-12);  // from the other end
  CHECK((crack.direction_at(first, 100.0) + along).norm() < 1e-12);
}
