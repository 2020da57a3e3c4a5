// SPDX-License-Identifier: MIT
#include "solver/cracks/line_points.hpp"

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
  CHECK(kept.front() == 0);
  CHECK(kept.back() == 1000);
  CHECK(kept[1] == 50);
  const Numbers coarse = resolved_points(straight({0, 0, 0}, {8, 0, 0}, 10), cell);
  CHECK(coarse.size() == 11);  // segments longer than a quarter of a cell stay
  CHECK(resolved_points(straight({0, 0, 0}, {0.3, 0, 0}, 1), cell) == Numbers{0, 1});
}

TEST_CASE("corners, teeth and folds of a line are kept", "[cracks]") {
  auto line = straight({0, 0, 0}, {0.1, 0, 0}, 10);
  for (const Vec3& x : straight({0.1, 0.01, 0}, {0.1, 0.1, 0}, 9)) line.push_back(x);
  CHECK(resolved_points(line, 1.0) == Numbers{0, 10, 20});
  std::vector<Vec3> teeth;
  for (int k = 0; k < 20; ++k) teeth.emplace_back(0.01 * k, k % 2 ? 1e-3 : 0.0, 0.0);
  CHECK(resolved_points(teeth, 1.0).size() == teeth.size());
  for (Vec3& x : teeth) x[1] *= 0.05;  // below the tolerance
  CHECK(resolved_points(teeth, 1.0) == Numbers{0, 19});
  const std::vector<Vec3> fold{{0, 0, 0}, {0.1, 0, 0}, {0.05, 0, 0}};
  CHECK(resolved_points(fold, 1.0) == Numbers{0, 1, 2});
}

TEST_CASE("a finely divided arc stays within a ten-thousandth of a cell", "[cracks]") {
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
    CHECK(farthest < 1.0001e-4);
  }
}
