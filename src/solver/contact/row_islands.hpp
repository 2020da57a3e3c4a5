// SPDX-License-Identifier: MIT
/// Small sets of the rows of a system of equations that have no unknown in common with other rows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tribo {

/// Splits the rows of a sparse system into sets that share no unknown, and lists the small ones: the islands.
class RowIslands {
 public:
  /// Sets with more rows are no islands.
  static constexpr std::size_t largest = 8;

  /// Finds the islands of `row_count` rows. `each_unknown(k, f)` calls f(number of the unknown) for the unknowns of row
  /// k, less than `unknown_count`.
  template <class EachUnknown>
  void find(std::size_t row_count, std::size_t unknown_count, EachUnknown&& each_unknown) {
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    const auto count = static_cast<std::uint32_t>(row_count);
    first_row_.resize(count), row_of_unknown_.assign(unknown_count, none);
    for (std::uint32_t k = 0; k < count; ++k) {
      first_row_[k] = k;
      each_unknown(k, [&](std::size_t unknown) {
        std::uint32_t& other = row_of_unknown_[unknown];
        if (other == none) other = k;
        const std::uint32_t a = first_row(other), b = first_row(k);
        first_row_[std::max(a, b)] = std::min(a, b);
      });
    }
    list();
  }

  std::size_t count() const { return ends_.size(); }
  /// The rows of an island, in ascending order.
  std::span<const std::uint32_t> rows(std::size_t island) const {
    const std::size_t first = island == 0 ? 0 : ends_[island - 1];
    return {rows_.data() + first, ends_[island] - first};
  }
  bool contain(std::size_t row) const { return set_sizes_[first_row_[row]] <= largest; }

 private:
  // The first row of the set of row k.
  std::uint32_t first_row(std::uint32_t k) {
    while (first_row_[k] != k) k = first_row_[k] = first_row_[first_row_[k]];
    return k;
  }
  void list();

  std::vector<std::uint32_t> first_row_;  // per row: the first one of its set, or meanwhile one that leads there
  std::vector<std::uint32_t> row_of_unknown_, set_sizes_, island_of_;  // the latter two of the first rows of sets
  std::vector<std::uint32_t> rows_;                                    // of all islands
  std::vector<std::size_t> ends_;                                      // of the islands in rows_
};

}  // namespace tribo
