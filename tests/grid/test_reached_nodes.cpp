// SPDX-License-Identifier: MIT
#include "grid/nodes.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEMPLATE_TEST_CASE_SIG("blocks know the nodes that are reached, and visit exactly these", "[grid]", ((int Dim), Dim), 2,
                       3) {
  Index<Dim> cells;
  cells.fill(16);
  const Lattice<Dim> lattice(Vec<Dim>::Zero(), Vec<Dim>::Constant(16.0), cells);
  constexpr int edge = block_edge<Dim>;
  Index<Dim> at;
  at.fill(3);
  std::vector<BlockReach<Dim>> occupied{{lattice.block_index(at), {}, {}}};
  occupied[0].low.fill(-1), occupied[0].high.fill(2);
  at[0] = 4;
  occupied.push_back({lattice.block_index(at), {}, {}});
  occupied[1].low.fill(1), occupied[1].high.fill(edge + 1);
  const auto is_reached = [&](const Index<Dim>& node) {
    bool any = false;
    for (const BlockReach<Dim>& reach : occupied) {
      const Index<Dim> block = lattice.block_at(reach.block);
      bool in_box = true;
      for (std::size_t d = 0; d < Dim; ++d) {
        const int from_block = node[d] - block[d] * edge;
        in_box = in_box && from_block >= reach.low[d] && from_block <= reach.high[d];
      }
      any = any || in_box;
    }
    return any;
  };
  BlockMap<Dim> map(lattice);
  map.rebuild(occupied);
  const auto nodes = static_cast<std::size_t>(map.node_count());
  std::vector<int> visits(nodes, 0);
  map.each_run(0, map.active().size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) ++visits[n];
  });
  std::size_t reached = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    const bool expected = is_reached(map.node_at(static_cast<std::int64_t>(n)));
    CHECK(visits[n] == (expected ? 1 : 0));
    CHECK((map.reached(n / block_nodes<Dim>) >> n % block_nodes<Dim> & 1) == (expected ? 1 : 0));
    reached += expected ? 1 : 0;
  }
  std::size_t box_of_first = 1, box_of_second = 1;  // the boxes overlap in no node
  for (int d = 0; d < Dim; ++d) box_of_first *= 4, box_of_second *= static_cast<std::size_t>(edge) + 1;
  CHECK(reached == box_of_first + box_of_second);

  std::size_t existing = 0;
  Index<Dim> last;
  last.fill(0);
  for (std::size_t d = 0; d < Dim; ++d) last[d] = lattice.blocks[d] - 1;
  each_in_box<Dim>({}, last, [&](const Index<Dim>& block) {
    const int slot = map.slot(block);
    existing += slot >= 0 ? 1 : 0;
    if (slot >= 0) CHECK(map.active()[static_cast<std::size_t>(slot)] == lattice.block_index(block));
  });
  CHECK(existing == map.active().size());
  CHECK(BlockMap<Dim>(lattice).slot(at) == -1);

  map.reach_all();
  std::size_t all = 0;
  map.each_run(0, map.active().size(), [&](std::size_t first, std::size_t last) { all += last - first; });
  CHECK(all == nodes);
}
