// SPDX-License-Identifier: MIT
/// Shape functions of a batch of points, and the dense patch of nodes around one block for the transfers of a bin.
#pragma once

#include "base/simd.hpp"
#include "grid/kernels.hpp"
#include "grid/nodes.hpp"

#include <cstring>
#include <type_traits>

namespace tribo {

/// Number of points that are processed together: large enough to vectorise, small enough for the first-level cache.
inline constexpr int batch = 64;
inline constexpr int batch_lanes = batch;

/// The nodes of the stencils of all points of one block, including drift of up to one cell since the last sort.
template <int Dim, int width>
struct Patch {
  static constexpr int edge = block_edge<Dim> + 1 + width;
  static constexpr int row = edge;  ///< nodes from y to y + 1
  /// Nodes from z to z + 1; the odd node avoids aliasing of cache sets.
  static constexpr int plane = edge * edge + 1;
  static constexpr int size = Dim == 2 ? edge * edge : plane * edge;

  alignas(64) double data[size * 8];

  /// Sets all values to zero.
  void clear() { std::memset(data, 0, sizeof data); }

  /// The node of the lattice at an offset, in doubles, of the patch of a block.
  static Index<Dim> node(const Index<Dim>& block, int offset) {
    Index<Dim> out;
    const int at = offset / 8;
    if constexpr (Dim == 3) out[2] = at / plane;
    const int in_plane = Dim == 3 ? at % plane : at;
    out[0] = in_plane % row, out[1] = in_plane / row;
    for (std::size_t d = 0; d < Dim; ++d) out[d] += block[d] * block_edge<Dim> - 1;
    return out;
  }

  using Blocks = typename BlockMap<Dim>::Neighbours;

  /// Copies the nodes of a block and its neighbours to the patch. Where no stencil reaches, it is left as it is.
  void load(const Blocks& blocks, NodeNumbers nodes) {
    each_run(blocks, [&](double* patch, std::size_t node, auto count) {
      std::memcpy(patch, nodes[node], sizeof(double) * NodeNumbers::per_node * count);
    });
  }

  /// Adds the patch to the nodes of a block and its neighbours.
  void add_to(const Blocks& blocks, NodeNumbers nodes) {
    each_run(blocks, [&](const double* patch, std::size_t node, auto count) {
      double* to = nodes[node];
      for (int i = 0; i < static_cast<int>(8 * count); i += 8)
        (Wide::load(to + i) + Wide::load(patch + i)).store(to + i);
    });
  }

 private:
  // Calls f(patch, first node in the layers, count) for every run of nodes along x of which some are reached. Along
  // each axis the patch consists of the last node of the block below, the nodes of the block, and the first nodes of
  // the block above. Counts are types, so that the compiler unrolls the copies.
  template <class F>
  void each_run(const Blocks& blocks, F&& f) {
    constexpr int B = block_edge<Dim>;
    struct Part {
      int patch, node, count;
    };
    constexpr Part parts[3] = {{0, B - 1, 1}, {1, 0, B}, {1 + B, 0, edge - 1 - B}};
    std::size_t k = 0;
    for (int pz = 0; pz < (Dim == 2 ? 1 : 3); ++pz)
      for (int py = 0; py < 3; ++py, k += 3) {
        const Part y = parts[py], z = Dim == 2 ? Part{0, 0, 1} : parts[pz];
        const auto run = [&](std::size_t px, auto count) {
          const std::uint64_t reached = blocks.reached[k + px];
          if (reached == 0) return;
          const Part x = parts[px];
          const auto first = static_cast<std::size_t>(blocks.slots[k + px]) * block_nodes<Dim>;
          for (int c = 0; c < z.count; ++c)
            for (int b = 0; b < y.count; ++b) {
              const int local = ((z.node + c) * B + y.node + b) * B + x.node;
              if ((reached >> local & ((std::uint64_t{1} << count) - 1)) == 0) continue;
              f(data + ((z.patch + c) * plane + (y.patch + b) * row + x.patch) * 8,
                first + static_cast<std::size_t>(local), count);
            }
        };
        run(0, std::integral_constant<std::size_t, 1>{});
        run(1, std::integral_constant<std::size_t, B>{});
        run(2, std::integral_constant<std::size_t, edge - 1 - B>{});
      }
  }
};

/// Shape functions, their derivatives [1/length] and the lowest patch node for a batch of points.
template <int Dim, class Kernel>
struct Stencils {
  static constexpr int width = Kernel::width;
  alignas(64) double w[Dim][width][batch_lanes];
  alignas(64) double g[Dim][width][batch_lanes];
  alignas(64) double r[Dim][batch_lanes];  ///< position minus lowest node [cells]
  alignas(64) int base[batch_lanes];       ///< offset of the lowest node in the patch, in doubles

  /// `half`: half widths of the particle domains, arrays or null for the uniform value.
  void compute(const Lattice<Dim>& lattice, const Index<Dim>& block, const std::array<double*, Dim>& x,
               std::uint32_t first, int count, const std::array<const double*, Dim>& half,
               const Vec<Dim>& uniform_half) {
    using P = Patch<Dim, width>;
    constexpr int stride[3] = {8, 8 * P::row, 8 * P::plane};
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const double inverse = 1.0 / lattice.spacing[d];
      const double origin = lattice.origin[d] * inverse + (block[k] * block_edge<Dim> - 1);
      const double* __restrict position = x[k] + first;
      const double* __restrict size = half[k] ? half[k] + first : nullptr;
      const double uniform = uniform_half[d] * inverse;
      for (int i = 0; i < count; i += lane_count) {
        const Lanes s = load_lanes(position + i) * inverse - origin;
        const IntLanes b = __builtin_convertvector(s - Kernel::shift, IntLanes);
        const Lanes local = s - __builtin_convertvector(b, Lanes);
        const Lanes half_cells = Kernel::sized && size ? load_lanes(size + i) * inverse : Lanes{} + uniform;
        Lanes ww[width], gg[width];
        Kernel::at(local, half_cells, ww, gg);
        for (int n = 0; n < width; ++n) store_lanes(w[d][n] + i, ww[n]), store_lanes(g[d][n] + i, gg[n] * inverse);
        store_lanes(r[d] + i, local);
        store_lanes(base + i, d == 0 ? b * stride[d] : load_lanes(base + i) + b * stride[d]);
      }
    }
  }
};

}  // namespace tribo
