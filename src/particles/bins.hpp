// SPDX-License-Identifier: MIT
/// Particles of a body sorted by block of cells, and the order in which blocks may be worked on at the same time.
#pragma once

#include "grid/lattice.hpp"
#include "particles/particles.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// A block that holds particles, and which: [begin, end).
struct Bin {
  std::int64_t block;
  std::uint32_t begin, end;
};

inline void archive(Archive& a, Bin& bin) {
  auto& [block, begin, end] = bin;
  a("block", block), a("begin", begin), a("end", end);
}

/// Particles lie in the bin of the block of their stencil's lowest node. Between sorts they may drift by less than one
/// cell; every transfer allows for that. Blocks of one colour never write to the same node, so a scatter runs through
/// the colours one after the other, in parallel within a colour: no atomics, and the same sums on any number of
/// threads.
template <int Dim>
class Bins {
 public:
  /// `shift`: of the kernel's base; `colours_per_axis`: 2 where stencil plus drift fit two blocks, else 3.
  Bins(double shift, int colours_per_axis) : shift_(shift), colours_per_axis_(colours_per_axis) {}

  /// Sorts the particles. Returns the index of a particle outside the lattice's user grid (or not a number), or -1.
  std::int64_t sort(const Lattice<Dim>& lattice, Particles<Dim>& particles);

  /// The particles must be in the order of the bins. Colours follow from the bins.
  friend void archive(Archive& a, Bins& bins, const Lattice<Dim>& lattice) {
    auto& [shift, colours_per_axis, list, colours, before] = bins;
    a.enter("bins");
    a.version(1);
    a.resizable("list", list);
    a.leave();
    if (a.reading()) bins.paint(lattice);
  }

  const std::vector<Bin>& list() const { return bins_; }
  /// Bins of one colour, as positions in list().
  const std::vector<std::vector<std::uint32_t>>& colours() const { return colours_; }
  /// Particles in the first k bins of a colour.
  std::uint32_t before(std::size_t colour, std::size_t k) const { return before_[colour][k]; }
  /// Particles in the first k bins of all.
  std::uint32_t before(std::size_t k) const { return k == 0 ? 0 : bins_[k - 1].end; }

 private:
  void paint(const Lattice<Dim>& lattice);

  double shift_;
  int colours_per_axis_;
  std::vector<Bin> bins_;
  std::vector<std::vector<std::uint32_t>> colours_, before_;
};

}  // namespace tribo
