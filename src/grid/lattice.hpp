// SPDX-License-Identifier: MIT
/// The regular lattice of nodes and its division into blocks.
#pragma once

#include "base/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tribo {

/// Nodes per block edge. A block is the unit of sorting, threading, memory and (with a halo) of distribution.
template <int Dim>
inline constexpr int block_edge = Dim == 2 ? 8 : 4;
template <int Dim>
inline constexpr int block_nodes = 64;  // 8^2 and 4^3

template <int Dim>
using Index = std::array<int, static_cast<std::size_t>(Dim)>;

/// Calls f(index) for all indices of a box, low <= index <= high along every axis, x fastest.
template <int Dim, class F>
void each_in_box(const Index<Dim>& low, const Index<Dim>& high, F&& f) {
  Index<Dim> n = low;
  for (int z = Dim == 3 ? low[Dim - 1] : 0; z <= (Dim == 3 ? high[Dim - 1] : 0); ++z)
    for (n[1] = low[1]; n[1] <= high[1]; ++n[1])
      for (n[0] = low[0]; n[0] <= high[0]; ++n[0]) {
        if constexpr (Dim == 3) n[2] = z;
        f(n);
      }
}

/// Geometry only; nodal data are in nodes.hpp. The grid of the input is surrounded by padding, so that the blocks of
/// all stencils of points inside it, and the neighbours of these blocks, always exist.
template <int Dim>
struct Lattice {
  static constexpr int padding = 2 * block_edge<Dim>;  ///< nodes below the lowest node of the input grid

  Vec<Dim> origin;     ///< lowest node, padding included                [length]
  Vec<Dim> spacing;    ///< cell edges                                   [length]
  Vec<Dim> low, high;  ///< limits of the input grid, for particles       [length]
  Index<Dim> blocks;   ///< blocks along each axis, padding included

  Lattice() = default;
  Lattice(const Vec<Dim>& from, const Vec<Dim>& to, const Index<Dim>& cells) : low(from), high(to) {
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      spacing[d] = (to[d] - from[d]) / cells[k];
      origin[d] = from[d] - padding * spacing[d];
      blocks[k] = (cells[k] + 1 + 2 * padding + block_edge<Dim> - 1) / block_edge<Dim>;
    }
  }

  std::int64_t block_count() const {
    std::int64_t n = 1;
    for (const int b : blocks) n *= b;
    return n;
  }
  std::int64_t block_index(const Index<Dim>& b) const {
    std::int64_t n = 0;
    for (std::size_t d = Dim; d-- > 0;) n = n * blocks[d] + b[d];
    return n;
  }
  Index<Dim> block_at(std::int64_t index) const {
    Index<Dim> b{};
    for (std::size_t d = 0; d < Dim; ++d) b[d] = static_cast<int>(index % blocks[d]), index /= blocks[d];
    return b;
  }
  /// The block that contains a point, or the nearest one for points outside.
  Index<Dim> block_of(const Vec<Dim>& x) const {
    Index<Dim> block;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      const double edge = spacing[axis] * block_edge<Dim>;
      block[d] = static_cast<int>(std::clamp(std::floor((x[axis] - origin[axis]) / edge), 0.0, blocks[d] - 1.0));
    }
    return block;
  }
  /// Number of the cell that contains a point, which must be within the padding.
  std::int64_t cell_number(const Vec<Dim>& x) const {
    std::int64_t n = 0;
    for (int d = Dim; d-- > 0;)
      n = n * blocks[static_cast<std::size_t>(d)] * block_edge<Dim> +
          static_cast<std::int64_t>(std::floor((x[d] - origin[d]) / spacing[d]));
    return n;
  }
  /// Difference of the numbers of neighbouring cells along an axis.
  std::int64_t cell_stride(int axis) const {
    std::int64_t n = 1;
    for (std::size_t d = 0; d < static_cast<std::size_t>(axis); ++d) n *= blocks[d] * block_edge<Dim>;
    return n;
  }
  Vec<Dim> position(const Index<Dim>& node) const {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = origin[d] + spacing[d] * node[static_cast<std::size_t>(d)];
    return x;
  }
  /// Index of the grid line at coordinate `x` of an axis, or -1 if there is none within 1e-6 cells.
  int line(int axis, double x) const {
    const double s = (x - origin[axis]) / spacing[axis];
    const double n = std::round(s);
    const int last = blocks[static_cast<std::size_t>(axis)] * block_edge<Dim> - 1;
    return std::abs(s - n) < 1e-6 && n >= 0 && n <= last ? static_cast<int>(n) : -1;
  }
  double smallest_spacing() const { return spacing.minCoeff(); }
};

}  // namespace tribo
