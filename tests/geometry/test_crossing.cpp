// SPDX-License-Identifier: MIT
/// Crossings against integer arithmetic, in which no number is rounded.

#include "geometry/crossing.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tribo;

namespace {

__extension__ typedef __int128 Big;
template <int Dim>
using Corner = std::array<long, static_cast<std::size_t>(Dim)>;

/// The moves by e, e^2, e^3 as numbers: coordinates are scaled up so far that one unit is less than any difference.
struct Scaled {
  static constexpr Big unit2 = Big(1) << 40, first2 = Big(1) << 18, second2 = 1;
};

Big turn(const std::array<Big, 2>& a, const std::array<Big, 2>& b, const std::array<Big, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int crossing_by_integers(const std::array<Corner<2>, 2>& piece, const Corner<2>& from, const Corner<2>& to) {
  const auto still = [](const Corner<2>& c) { return std::array<Big, 2>{c[0] * Scaled::unit2, c[1] * Scaled::unit2}; };
  const auto moved = [&](const Corner<2>& c) {
    auto p = still(c);
    p[0] += Scaled::first2, p[1] += Scaled::second2;
    return p;
  };
  const auto a = still(piece[0]), b = still(piece[1]), p = moved(from), q = moved(to);
  const int start = turn(a, b, p) > 0 ? 1 : -1;
  if ((turn(a, b, p) > 0) == (turn(a, b, q) > 0)) return 0;
  return (turn(p, q, a) > 0) == (turn(p, q, b) > 0) ? 0 : start;
}

Vec<2> place(const Corner<2>& c) { return {static_cast<double>(c[0]), static_cast<double>(c[1])}; }

}  // namespace

TEST_CASE("CR0: crossings of a million random segments, most of them degenerate, are exact", "[crossing]") {
  std::mt19937 random(1);
  long errors = 0, crossed = 0;
  for (const int size : {3, 8, 1000}) {
    std::uniform_int_distribution<long> coordinate(-size, size);
    for (int k = 0; k < 350000; ++k) {
      Corner<2> c[4];
      for (auto& corner : c) corner = {coordinate(random), coordinate(random)};
      if (k % 3 == 0) c[3] = c[k % 2];  // through an end point
      if (c[0] == c[1] || c[2] == c[3]) continue;
      const int wanted = crossing_by_integers({c[0], c[1]}, c[2], c[3]);
      const Vec<2> a = place(c[0]), b = place(c[1]), from = place(c[2]), to = place(c[3]);
      crossed += wanted != 0;
      errors += crossing({a, b}, from, to) != wanted;
      errors += crossing({a, b}, to, from) != -wanted;
      errors += crossing({b, a}, from, to) != -wanted;
    }
  }
  CHECK(errors == 0);
  CHECK(crossed > 10000);
}

TEST_CASE("a segment crosses a polyline once, also through its corners and along it", "[crossing]") {
  // A zigzag from far left to far right parts the plane: ways between above and below cross it an odd number of times.
  std::mt19937 random(2);
  std::uniform_int_distribution<int> coordinate(-4, 4);
  long errors = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Vec<2>> line{{-100, 0}};
    for (int x = -4; x <= 4; x += 2) line.push_back({x, coordinate(random)});
    line.push_back({100, 0});
    const auto above = [&](const Vec<2>& p) {  // crossings of the way from far above
      int sum = 0;
      for (std::size_t k = 0; k + 1 < line.size(); ++k) sum += crossing({line[k], line[k + 1]}, p, Vec<2>(p[0], 1000));
      return sum == 0;
    };
    for (int k = 0; k < 50; ++k) {
      const Vec<2> p(coordinate(random), coordinate(random)), q(coordinate(random), coordinate(random));
      if (p == q) continue;
      int sum = 0;
      for (std::size_t n = 0; n + 1 < line.size(); ++n) sum += crossing({line[n], line[n + 1]}, p, q);
      errors += sum != (above(p) ? 1 : 0) - (above(q) ? 1 : 0);
    }
  }
  CHECK(errors == 0);
}

TEST_CASE("CR0 in three dimensions: the number of crossings of a closed surface has the right parity", "[crossing]") {
  // The octahedron and its sides, ways through corners, along edges and within faces included
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coordinate(-3, 3);
  const Vec3 tips[6] = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}};
  std::vector<std::array<Vec3, 3>> faces;
  for (int k = 0; k < 8; ++k) {
    const Vec3 &a = tips[k & 1], &b = tips[2 + (k >> 1 & 1)], &c = tips[4 + (k >> 2)];
    const bool outward = (b - a).cross(c - a).dot(a + b + c) > 0;
    faces.push_back(outward ? std::array{a, b, c} : std::array{a, c, b});
  }
  const auto crossings = [&](const Vec3& p, const Vec3& q) {
    int sum = 0;
    for (const auto& face : faces) sum += crossing(face, p, q);
    return sum;
  };
  long errors = 0, crossed = 0;
  for (int k = 0; k < 200000; ++k) {
    const Vec3 p(coordinate(random), coordinate(random), coordinate(random)),
        q(coordinate(random), coordinate(random), coordinate(random));
    if (p == q) continue;
    const auto outside = [&](const Vec3& x) { return crossings(x, Vec3(1000, 10, 1)) == 0 ? 1 : 0; };
    const int sum = crossings(p, q);
    crossed += sum != 0;
    errors += sum != outside(p) - outside(q);
    errors += crossings(q, p) != -sum;
    for (const auto& [a, b, c] : faces) {
      const int here = crossing({a, b, c}, p, q);
      errors += crossing({b, c, a}, p, q) != here;
      errors += crossing({b, a, c}, p, q) != -here;
    }
  }
  CHECK(errors == 0);
  CHECK(crossed > 10000);
}

TEST_CASE("sides are exact where round-off would decide", "[crossing]") {
  // (0.5, 0.5) + k ulp against the line through (12, 12) and (24, 24): a plain determinant errs for many of these.
  const double ulp = std::ldexp(1.0, -53);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const Vec<2> p(0.5 + i * ulp * 2, 0.5 + j * ulp * 2);
      const int wanted = j > i ? 1 : j < i ? -1 : -1;  // on the line: the move by (e, e^2) goes right
      CHECK(side_of({Vec<2>(12, 12), Vec<2>(24, 24)}, p) == wanted);
    }
}
