// SPDX-License-Identifier: MIT
#include "run/rank_plan.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tribo;

namespace {

// A cube of so many blocks along each edge, all full of particles.
BlockCounts cube(const Lattice<3>& lattice, int edge, std::int64_t particles) {
  BlockCounts out;
  each_in_box<3>({4, 4, 4}, {3 + edge, 3 + edge, 3 + edge},
                 [&](const Index<3>& block) { out.emplace_back(lattice.block_index(block), particles); });
  std::ranges::sort(out);
  return out;
}

Lattice<3> lattice_of(int blocks) {
  const int cells = blocks * block_edge<3>;
  return {Vec3::Zero(), Vec3::Constant(cells), {cells, cells, cells}};
}

}  // namespace

TEST_CASE("processes share the blocks of a cube, and the copies are those at their borders", "[rank_plan]") {
  const auto lattice = lattice_of(16);
  const auto blocks = cube(lattice, 8, 100);
  const auto shares = share_of_ranks<3>(lattice, blocks, 8, 1);
  REQUIRE(shares.size() == 8);
  CHECK(imbalance(shares) == 1.0);
  for (const RankShare& share : shares) {
    CHECK(share.particles == 64 * 100);  // an octant
    CHECK(share.blocks == 64);
    CHECK(share.partners == 7);
    CHECK(share.ghosts == (125 - 64) * 100);
    // three sides with one copy, three edges with three and a corner with seven
    CHECK(share.sent == (3 * 9 * 1 + 3 * 3 * 3 + 7) * 100);
  }
}

TEST_CASE("every process has copies of what is around common blocks", "[rank_plan]") {
  const auto lattice = lattice_of(16);
  const auto blocks = cube(lattice, 8, 1);
  const std::vector<std::int64_t> common{lattice.block_index({4, 4, 4})};
  const auto shares = share_of_ranks<3>(lattice, blocks, 8, 1, common);
  CHECK(shares[0].particles == 64);
  CHECK(shares[7].ghosts == 61 + 8);  // none of the eight touches it
  CHECK(shares[0].ghosts == 61);
}

TEST_CASE("many processes share a thousand million particles evenly", "[rank_plan]") {
  const auto lattice = lattice_of(136);
  const auto blocks = cube(lattice, 128, 512);
  for (const int ranks : {64, 512}) {
    const auto shares = share_of_ranks<3>(lattice, blocks, ranks, 1);
    std::int64_t all = 0, sent = 0, received = 0;
    for (const RankShare& share : shares) all += share.particles, sent += share.sent, received += share.ghosts;
    CHECK(all == std::int64_t{128} * 128 * 128 * 512);
    CHECK(sent == received);
    CHECK(imbalance(shares) < 1.001);
  }
}

TEST_CASE("processes without particles are possible", "[rank_plan]") {
  const auto lattice = lattice_of(16);
  const auto shares = share_of_ranks<3>(lattice, cube(lattice, 1, 10), 4, 1);
  CHECK(std::ranges::count(shares, 0, &RankShare::particles) == 3);
  CHECK(imbalance(shares) == 4.0);
}
