/// Weights of a batch of points, and the small dense patch of nodes around one block that a bin works on.
#pragma once

#include "base/simd.hpp"
#include "grid/kernels.hpp"
#include "grid/nodes.hpp"

#include <cstring>

namespace tribo {

/// Points worked on together: large enough to vectorise, small enough for the first-level cache.
inline constexpr int batch = 64;
inline constexpr int batch_lanes = batch + 8;

/// The nodes that points of one block can reach, drift of up to one cell included.
template <int Dim, int width>
struct Patch {
  static constexpr int edge = block_edge<Dim> + 1 + width;
  static constexpr int row = edge;               ///< nodes from y to y + 1
  static constexpr int plane = edge * edge + 1;  ///< nodes from z to z + 1; the odd node avoids aliasing of cache sets
  static constexpr int size = Dim == 2 ? edge * edge : plane * edge;

  alignas(64) double data[size * 8];

  void clear() { std::memset(data, 0, sizeof data); }

  /// Calls f(doubles in the patch, first node in the layers, count) for each run of nodes along x.
  template <class F>
  static void each_run(const std::array<int, BlockMap<Dim>::neighbour_count>& slots, F&& f) {
    constexpr int B = block_edge<Dim>;
    // Per axis: part -1 is the last node of the neighbour below, 0 the block, 1 the first nodes of the one above.
    struct Part {
      int patch, node, count;
    };
    constexpr Part parts[3] = {{0, B - 1, 1}, {1, 0, B}, {1 + B, 0, edge - 1 - B}};
    std::size_t k = 0;
    for (int pz = 0; pz < (Dim == 2 ? 1 : 3); ++pz)
      for (int py = 0; py < 3; ++py)
        for (int px = 0; px < 3; ++px) {
          const std::int64_t first = static_cast<std::int64_t>(slots[k++]) * block_nodes<Dim>;
          const Part x = parts[px], y = parts[py], z = Dim == 2 ? Part{0, 0, 1} : parts[pz];
          for (int c = 0; c < z.count; ++c)
            for (int b = 0; b < y.count; ++b)
              f(((z.patch + c) * plane + (y.patch + b) * row + x.patch) * 8,
                first + ((z.node + c) * B + y.node + b) * B + x.node, x.count);
        }
  }

  void load(const std::array<int, BlockMap<Dim>::neighbour_count>& slots, const NodeLayer& nodes) {
    each_run(slots, [&](int at, std::int64_t node, int count) {
      std::memcpy(data + at, nodes[static_cast<std::size_t>(node)].data(),
                  sizeof(Node) * static_cast<std::size_t>(count));
    });
  }

  void add_to(const std::array<int, BlockMap<Dim>::neighbour_count>& slots, NodeLayer& nodes) const {
    each_run(slots, [&](int at, std::int64_t node, int count) {
      double* to = nodes[static_cast<std::size_t>(node)].data();
      for (int i = 0; i < count; ++i) (Wide::load(to + 8 * i) + Wide::load(data + at + 8 * i)).store(to + 8 * i);
    });
  }
};

/// Weights, slopes [1/length] and lowest patch node of a batch.
template <int Dim, class Kernel>
struct Stencils {
  static constexpr int width = Kernel::width;
  alignas(64) double w[Dim][width][batch_lanes];
  alignas(64) double g[Dim][width][batch_lanes];
  alignas(64) double r[Dim][batch_lanes];  ///< position minus lowest node [cells]
  alignas(64) int base[batch_lanes];       ///< of the lowest node in the patch, in doubles

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
      const int step = stride[d];
#pragma omp simd
      for (int i = 0; i < count; ++i) {
        const double s = position[i] * inverse - origin;
        const int b = static_cast<int>(s - Kernel::shift);
        const double local = s - b;
        double ww[width], gg[width];
        Kernel::at(local, Kernel::sized ? (size ? size[i] * inverse : uniform) : 0.0, ww, gg);
        for (int n = 0; n < width; ++n) w[d][n][i] = ww[n], g[d][n][i] = gg[n] * inverse;
        r[d][i] = local;
        base[i] = d == 0 ? b * step : base[i] + b * step;
      }
    }
  }
};

}  // namespace tribo
