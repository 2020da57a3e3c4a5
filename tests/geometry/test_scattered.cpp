// SPDX-License-Identifier: MIT
#include "geometry/scattered.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tribo;

namespace {

ScatteredField::Values linear(const Vec3& x) { return {1 + x[0], 2 - 3 * x[1], x[2], 4.0, x[0] - x[1] + x[2], -x[1]}; }

void check_same(const ScatteredField::Values& a, const ScatteredField::Values& b) {
  for (std::size_t k = 0; k < a.size(); ++k) CHECK(a[k] == Approx(b[k]).margin(1e-9));
}

}  // namespace

TEST_CASE("linear fields are reproduced from scattered points, by interpolation and extrapolation", "[geometry]") {
  const int dimension = GENERATE(2, 3);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-2, 3);
  std::vector<Vec3> points;
  std::vector<ScatteredField::Values> values;
  for (int k = 0; k < 300; ++k) {
    points.emplace_back(any(random), any(random), dimension == 3 ? any(random) : 0.0);
    values.push_back(linear(points.back()));
  }
  const ScatteredField field(points, values, dimension);
  for (int k = 0; k < 50; ++k) {
    const Vec3 x(any(random), any(random), dimension == 3 ? any(random) : 0.0);
    check_same(field.at(x), linear(x));
  }
  check_same(field.at(points[7]), values[7]);
  const Vec3 outside(5, 1, 0);
  check_same(field.at(outside), linear(outside));
}

TEST_CASE("values at the given points are reproduced for any field", "[geometry]") {
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  std::vector<Vec3> points;
  std::vector<ScatteredField::Values> values;
  for (int k = 0; k < 100; ++k) {
    points.emplace_back(any(random), any(random), any(random));
    values.push_back({any(random), any(random), any(random), 0, 0, 0});
  }
  const ScatteredField field(points, values, 3);
  for (std::size_t k = 0; k < points.size(); ++k) check_same(field.at(points[k]), values[k]);
}

TEST_CASE("collinear points give no gradient across their line", "[geometry]") {
  std::vector<Vec3> points;
  std::vector<ScatteredField::Values> values;
  for (int k = 0; k <= 10; ++k) points.emplace_back(3, k, 0), values.push_back({-2.0 * k, 0, 0, 0, 0, 1});
  const ScatteredField field(points, values, 2);
  check_same(field.at({-7, 4.3, 0}), {-8.6, 0, 0, 0, 0, 1});
  const ScatteredField lone({Vec3(1, 2, 0)}, {{1, 2, 3, 4, 5, 6}}, 2);
  check_same(lone.at({9, 9, 0}), {1, 2, 3, 4, 5, 6});
}
