// SPDX-License-Identifier: MIT
/// Values per block, for some of the blocks of a lattice.
#pragma once

#include "grid/lattice.hpp"

#include <limits>
#include <utility>
#include <vector>

namespace tribo {

/// A box of blocks, low <= block <= high along every axis; empty at first.
template <int Dim>
struct BlockBox {
  Index<Dim> low = filled(std::numeric_limits<int>::max()), high = filled(-1);

  /// Extends the box so that it contains a block.
  void include(const Index<Dim>& block) {
    for (std::size_t d = 0; d < Dim; ++d) low[d] = std::min(low[d], block[d]), high[d] = std::max(high[d], block[d]);
  }
  bool contains(const Index<Dim>& block) const {
    for (std::size_t d = 0; d < Dim; ++d)
      if (block[d] < low[d] || block[d] > high[d]) return false;
    return true;
  }
  std::size_t count() const {
    std::size_t n = high[0] < low[0] ? 0 : 1;
    for (std::size_t d = 0; d < Dim && n > 0; ++d) n *= static_cast<std::size_t>(high[d] - low[d] + 1);
    return n;
  }
  /// Position of a block of the box, x fastest.
  std::size_t place(const Index<Dim>& block) const {
    std::size_t n = 0;
    for (std::size_t d = Dim; d-- > 0;)
      n = n * static_cast<std::size_t>(high[d] - low[d] + 1) + static_cast<std::size_t>(block[d] - low[d]);
    return n;
  }

 private:
  static Index<Dim> filled(int value) {
    Index<Dim> index;
    index.fill(value);
    return index;
  }
};

/// A value for each block of a box, and a common one for all other blocks. The memory is that of the box, so that small
/// bodies take little in large lattices.
template <int Dim, class T>
class BlockTable {
 public:
  /// `elsewhere`: the value of blocks outside the box.
  explicit BlockTable(T elsewhere) : elsewhere_(std::move(elsewhere)) {}

  /// Replaces the box; all its blocks then have the value `elsewhere`.
  void reset(const BlockBox<Dim>& box) { box_ = box, values_.assign(box.count(), elsewhere_); }
  const T& operator[](const Index<Dim>& block) const {
    return box_.contains(block) ? values_[box_.place(block)] : elsewhere_;
  }
  /// The value of a block of the box.
  T& at(const Index<Dim>& block) { return values_[box_.place(block)]; }

 private:
  BlockBox<Dim> box_;
  T elsewhere_;
  std::vector<T> values_;
};

/// Flags of blocks: 1 or 0.
template <int Dim>
using BlockFlags = BlockTable<Dim, char>;

}  // namespace tribo
