// SPDX-License-Identifier: MIT
/// Tables of values for the blocks of a box.

#include "grid/block_table.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("a box of blocks grows with the blocks that it includes", "[grid]") {
  BlockBox<3> box;
  CHECK(box.count() == 0);
  CHECK_FALSE(box.contains({0, 0, 0}));
  box.include({4, 5, 6});
  CHECK(box.count() == 1);
  box.include({2, 5, 9});
  CHECK(box.count() == 3 * 1 * 4);
  CHECK(box.contains({3, 5, 7}));
  CHECK_FALSE(box.contains({3, 4, 7}));
  CHECK_FALSE(box.contains({5, 5, 7}));
  CHECK(box.place({2, 5, 6}) == 0);
  CHECK(box.place({4, 5, 9}) == box.count() - 1);
}

TEST_CASE("a table of blocks has one value outside of its box", "[grid]") {
  BlockTable<2, int> table(-1);
  CHECK(table[{0, 0}] == -1);
  BlockBox<2> box;
  box.include({3, 7}), box.include({5, 8});
  table.reset(box);
  int number = 0;
  each_in_box<2>(box.low, box.high, [&](const Index<2>& block) { table.at(block) = number++; });
  number = 0;
  each_in_box<2>({0, 0}, {9, 9},
                 [&](const Index<2>& block) { CHECK(table[block] == (box.contains(block) ? number++ : -1)); });
  CHECK(table[{-1, 7}] == -1);
  table.reset(box);  // forgets the values
  CHECK(table[{4, 8}] == -1);
  table.reset({});
  CHECK(table[{3, 7}] == -1);
}
