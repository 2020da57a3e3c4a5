// SPDX-License-Identifier: MIT
/// Particles of a body sorted by blocks of cells, and the colouring of the blocks for parallel transfers.
#pragma once

#include "grid/lattice.hpp"
#include "grid/nodes.hpp"
#include "particles/particles.hpp"

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
    auto& [shift, colours_per_axis, list, cells, colours, before] = bins;
    a.enter("bins");
    a.version(2);
    a.resizable("list", list);
    cells.resize(list.size());
    a("cells", cells);
    a.leave();
    if (a.reading()) bins.paint(lattice);
  }

  /// Whether each particle is in the block of its bin or less than a cell from it.
  bool hold(const Lattice<Dim>& lattice, const Particles<Dim>& particles) const;

  const std::vector<Bin>& list() const { return bins_; }
  /// The blocks of the bins, and the nodes that stencils of `width` nodes per axis reach until the next sort.
  std::vector<BlockReach<Dim>> reach(const Lattice<Dim>& lattice, int width) const;
  /// Bins of each colour, as indices into list().
  const std::vector<std::vector<std::uint32_t>>& colours() const { return colours_; }
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
  std::vector<CellRange> cells_;  // per bin
  std::vector<std::vector<std::uint32_t>> colours_, before_;
};

}  // namespace tribo
