#include "grid/select.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("nodes on the border of a shape are selected whatever the rounding of their places", "[grid]") {
  NodeLattice nodes;
  nodes.low = Vec3(-0.7, 0.1, 0);
  nodes.spacing = Vec3(0.1, 0.1, 0.1);
  nodes.count = {15, 4, 1};
  // x = 0.2 ... 0.5 are nodes 9 ... 12, y = 0.3 is row 2
  CHECK(nodes_in(nodes, *rectangle(0.2, 0.5, 0.3, 0.3)) == std::vector<std::size_t>{39, 40, 41, 42});
  CHECK(nodes_in(nodes, *line(Vec3(0.2, 0.3, 0), Vec3(0.5, 0.3, 0), 0.01)) == std::vector<std::size_t>{39, 40, 41, 42});
}

TEST_CASE("nodes are numbered with x fastest", "[grid]") {
  NodeLattice nodes;
  nodes.count = {4, 3, 5};
  CHECK(nodes_in(nodes, *box(Vec3(1, 1, 2), Vec3(2, 2, 3))) ==
        std::vector<std::size_t>{29, 30, 33, 34, 41, 42, 45, 46});
}

TEST_CASE("a plane shape selects through all layers, and a shape elsewhere selects nothing", "[grid]") {
  NodeLattice nodes;
  nodes.count = {3, 3, 2};
  CHECK(nodes_in(nodes, *rectangle(1, 1, 1, 1)) == std::vector<std::size_t>{4, 13});
  CHECK(nodes_in(nodes, *rectangle(5, 6, 0, 2)).empty());
  CHECK(nodes_in(nodes, *rectangle(-6, -5, 0, 2)).empty());
}
