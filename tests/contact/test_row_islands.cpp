// SPDX-License-Identifier: MIT
#include "solver/contact/row_islands.hpp"

#include <catch2/catch.hpp>

#include <random>
#include <set>

using namespace tribo;

TEST_CASE("islands are the small sets of rows that share no unknown with others", "[contact]") {
  std::mt19937 random(1);
  for (int model = 0; model < 50; ++model) {
    const std::size_t row_count = 1 + random() % 60, unknown_count = 1 + random() % 120;
    std::vector<std::vector<std::size_t>> unknowns(row_count);
    for (auto& of_row : unknowns)
      for (std::size_t k = random() % 4; k-- > 0;) of_row.push_back(random() % unknown_count);
    RowIslands islands;
    islands.find(row_count, unknown_count, [&](std::size_t k, auto&& f) {
      for (const std::size_t unknown : unknowns[k]) f(unknown);
    });
    // The set of each row grows until no other row shares one of its unknowns.
    std::set<std::set<std::size_t>> wanted;
    for (std::size_t start = 0; start < row_count; ++start) {
      std::set<std::size_t> set{start};
      for (std::size_t before = 0; before != set.size();) {
        before = set.size();
        std::set<std::size_t> of_set;
        for (const std::size_t k : set) of_set.insert(unknowns[k].begin(), unknowns[k].end());
        for (std::size_t k = 0; k < row_count; ++k)
          for (const std::size_t unknown : unknowns[k])
            if (of_set.count(unknown) != 0) set.insert(k);
      }
      const bool small = set.size() <= RowIslands::largest;
      CHECK(islands.contain(start) == small);
      if (small) wanted.insert(set);
    }
    std::set<std::set<std::size_t>> found;
    for (std::size_t k = 0; k < islands.count(); ++k) {
      const auto rows = islands.rows(k);
      CHECK(std::is_sorted(rows.begin(), rows.end()));
      found.emplace(rows.begin(), rows.end());
    }
    CHECK(found == wanted);
  }
}
