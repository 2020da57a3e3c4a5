// SPDX-License-Identifier: MIT
/// Particles of a body sorted by blocks of cells, and the colouring of the blocks for parallel transfers.
#pragma once

#include "grid/lattice.hpp"
#include "grid/nodes.hpp"
#include "particles/particles.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tribo {

/// A block with particles, and their range [begin, end).
struct Bin {
  std::int64_t block;
  std::uint32_t begin, end;
};

inline void archive(Archive& a, Bin& bin) {
  auto& [block, begin, end] = bin;
  a("block", block), a("begin", begin), a("end", end);
}

/// A bin without its place among the particles, as other processes know it.
template <int Dim>
struct BinContent {
  std::int64_t block;
  std::uint32_t count;   ///< number of its particles
  Index<Dim> low, high;  ///< lowest and highest cell of the lowest nodes of its particles, in the block
};

/// A particle belongs to the bin of the block that contains the lowest node of its stencil. Between sorts it may move
/// by less than one cell, which every transfer allows for. Blocks of the same colour never write to the same node. A
/// particle-to-grid transfer processes one colour after the other, in parallel within a colour. It needs no atomics,
/// and its sums do not depend on the number of threads.
template <int Dim>
class Bins {
 public:
  /// `shift`: that of the kernel; `colours_per_axis`: 2 if stencil plus drift fit into two blocks, otherwise 3.
  Bins(double shift, int colours_per_axis) : shift_(shift), colours_per_axis_(colours_per_axis) {}

  /// Sorts the particles by block, cell and number. Returns the index of a particle outside the input grid (or with a
  /// NaN position), or -1.
  std::int64_t sort(const Lattice<Dim>& lattice, Particles<Dim>& particles);

  /// The particles must be in the order of the bins. Colours follow from the bins.
  friend void archive(Archive& a, Bins& bins, const Lattice<Dim>& lattice) {
    auto& [shift, colours_per_axis, list, own, cells, by_block, colours, before] = bins;
    a.enter("bins");
    a.version(2);
    a.resizable("list", list);
    own = list.size();
    cells.resize(list.size());
    a("cells", cells);
    a.leave();
    if (a.reading()) bins.paint(lattice);
  }

  /// Whether each particle is in the block of its bin or less than a cell from it.
  bool hold(const Lattice<Dim>& lattice, const Particles<Dim>& particles) const;

  /// The bins of the particles of this process, in the order of their blocks.
  std::span<const Bin> list() const { return {bins_.data(), own_}; }
  /// These bins, and behind them those of the ghosts.
  std::span<const Bin> with_ghosts() const { return bins_; }
  /// All of them in the order of their blocks, as indices into with_ghosts().
  const std::vector<std::uint32_t>& by_block() const { return by_block_; }
  /// The bins of this process as others know them.
  std::vector<BinContent<Dim>> contents() const;
  /// Replaces the bins: particles, and behind them ghosts, are in the order of these bins.
  void assign(const Lattice<Dim>& lattice, std::span<const BinContent<Dim>> own,
              std::span<const BinContent<Dim>> ghosts);

  /// The blocks of the bins, and the nodes that stencils of `width` nodes per axis reach until the next sort.
  std::vector<BlockReach<Dim>> reach(const Lattice<Dim>& lattice, int width) const;
  /// Bins of each colour, ghosts included, as indices into with_ghosts().
  const std::vector<std::vector<std::uint32_t>>& colours() const { return colours_; }
  /// Ranges of particles for sums over `count` of them: the bins if they hold so many, otherwise ranges of equal
  /// length, which are written to `pieces`. The sums over bins are the same on any number of processes.
  std::span<const Bin> sum_ranges(std::size_t count, std::vector<Bin>& pieces) const {
    static constexpr std::size_t length = 512;
    if (before(own_) == count) return list();
    pieces.clear();
    for (std::size_t first = 0; first < count; first += length)
      pieces.push_back(
          {0, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::min(count, first + length))});
    return pieces;
  }
  /// Number of particles in the first k bins of a colour.
  std::uint32_t before(std::size_t colour, std::size_t k) const { return before_[colour][k]; }
  /// Number of particles in the first k bins of the list.
  std::uint32_t before(std::size_t k) const { return k == 0 ? 0 : bins_[k - 1].end; }

 private:
  // Lowest and highest cell of the lowest nodes of the particles of a bin in its block, at the last sort.
  struct CellRange {
    Index<Dim> low, high;

    friend void archive(Archive& a, CellRange& range) {
      auto& [lowest, highest] = range;
      for (std::size_t d = 0; d < Dim; ++d)
        a("low" + std::to_string(d), lowest[d]), a("high" + std::to_string(d), highest[d]);
    }
  };

  void paint(const Lattice<Dim>& lattice);
  static CellRange range_of(std::span<const std::uint32_t> ends, std::uint32_t begin);

  double shift_;
  int colours_per_axis_;
  std::vector<Bin> bins_;
  std::size_t own_ = 0;           // number of bins before those of the ghosts
  std::vector<CellRange> cells_;  // per bin
  std::vector<std::uint32_t> by_block_;
  std::vector<std::vector<std::uint32_t>> colours_, before_;
};

}  // namespace tribo
