// SPDX-License-Identifier: MIT
#include "solver/contact/row_islands.hpp"

namespace tribo {

// Lists the islands in the order of their first rows.
void RowIslands::list() {
  const auto count = static_cast<std::uint32_t>(first_row_.size());
  set_sizes_.assign(count, 0), island_of_.resize(count), ends_.clear();
  for (std::uint32_t k = 0; k < count; ++k) ++set_sizes_[first_row_[k] = first_row(k)];
  std::size_t end = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (first_row_[k] != k || !contain(k)) continue;
    island_of_[k] = static_cast<std::uint32_t>(ends_.size());
    ends_.push_back(end);  // where its rows begin: each row that is added moves it on
    end += set_sizes_[k];
  }
  rows_.resize(end);
  for (std::uint32_t k = 0; k < count; ++k)
    if (contain(k)) rows_[ends_[island_of_[first_row_[k]]]++] = k;
}

}  // namespace tribo
