// SPDX-License-Identifier: MIT
#include "grid/select.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

// Nodes in a shape, counted from the lowest of the user's grid.
template <int Dim>
std::vector<std::array<int, 3>> found(const Lattice<Dim>& lattice, const Region& region) {
  std::vector<std::array<int, 3>> out;
  each_node_in<Dim>(lattice, region, [&](const Index<Dim>& node) {
    constexpr int pad = Lattice<Dim>::padding;
    out.push_back({node[0] - pad, node[1] - pad, Dim == 3 ? node[Dim - 1] - pad : 0});
  });
  return out;
}

using Nodes = std::vector<std::array<int, 3>>;

}  // namespace

TEST_CASE("nodes on the boundary of a shape are selected in spite of round-off", "[grid]") {
  const Lattice<2> lattice(Vec<2>(-0.7, 0.1), Vec<2>(0.7, 0.4), {14, 3});
  const Nodes row{{9, 2, 0}, {10, 2, 0}, {11, 2, 0}, {12, 2, 0}};
  CHECK(found(lattice, *rectangle(0.2, 0.5, 0.3, 0.3)) == row);
  CHECK(found(lattice, *line(Vec3(0.2, 0.3, 0), Vec3(0.5, 0.3, 0), 0.01)) == row);
}

TEST_CASE("a box without thickness selects its plane of nodes in spite of round-off", "[grid]") {
  const Lattice<3> lattice(Vec<3>(-0.1, -0.1, -0.1), Vec<3>(1.1, 1.3, 1.1), {24, 28, 24});
  for (const double at : {0.0, 0.15, 0.3, 0.35, 0.7, 1.0}) {
    INFO("at " << at);
    CHECK(found(lattice, *box(Vec3(-0.1, at, -0.1), Vec3(1.1, at, 1.1))).size() == 25 * 25);
    CHECK(found(lattice, *box(Vec3(at, -0.1, -0.1), Vec3(at, 1.3, 1.1))).size() == 29 * 25);
    CHECK(found(lattice, *box(Vec3(at, at, -0.1), Vec3(at, at, 1.1))).size() == 25);
    CHECK(found(lattice, *box(Vec3(-1, at + 1e-6, -1), Vec3(2, at + 1e-6, 2))).empty());
  }
}

TEST_CASE("nodes in a box come with x fastest", "[grid]") {
  const Lattice<3> lattice(Vec<3>(0, 0, 0), Vec<3>(3, 2, 4), {3, 2, 4});
  CHECK(found(lattice, *box(Vec3(1, 1, 2), Vec3(2, 2, 3))) ==
        Nodes{{1, 1, 2}, {2, 1, 2}, {1, 2, 2}, {2, 2, 2}, {1, 1, 3}, {2, 1, 3}, {1, 2, 3}, {2, 2, 3}});
}

TEST_CASE("a shape beyond the lattice selects nothing", "[grid]") {
  const Lattice<2> lattice(Vec<2>(0, 0), Vec<2>(2, 2), {2, 2});
  CHECK(found(lattice, *rectangle(1, 1, 1, 1)) == Nodes{{1, 1, 0}});
  CHECK(found(lattice, *rectangle(500, 600, 0, 2)).empty());
  CHECK(found(lattice, *rectangle(-600, -500, 0, 2)).empty());
}
