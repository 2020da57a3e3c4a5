// SPDX-License-Identifier: MIT
/// The sums over the stencil of one particle, for kernels that are products of one-dimensional shape functions. They
/// use vectors of the components of a node.
#pragma once

#include "solver/transfer/cut_patches.hpp"
#include "solver/transfer/particle_update.hpp"
#include "solver/transfer/scatter_terms.hpp"
#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer_sums.hpp"

namespace tribo {

/// Sums from a particle to the nodes of its stencil and back; the terms of a batch of particles are given. `i` is the
/// number of the particle in the batch, and `nodes` are NodesOfOneField or NodesBySide.
template <int Dim, class Kernel>
struct ProductSums {
  static constexpr int width = Kernel::width;
  using NodePatch = Patch<Dim, width>;

  /// Fills the affine terms of a batch. C = B D^-1 with D = sum w (x_i - x)(x_i - x)^T, diagonal for product kernels.
  /// Where D vanishes (a point on a node of the linear kernel), round-off would be amplified, so the affine part is set
  /// to zero.
  static void prepare_affine(Body<Dim>& body, const Lattice<Dim>& lattice, const Stencils<Dim, Kernel>& stencils,
                             std::uint32_t first, int count, ScatterTerms<Dim>& terms) {
    const double* m = body.particles.mass() + first;
    const auto affine = body.particles[body.affine];
    for (int d = 0; d < Dim; ++d) {
      const double h = lattice.spacing[d];
      for (int i = 0; i < count; i += 4) {
        Vec4 moment{};
        for (int n = 0; n < width; ++n) {
          const Vec4 distance = static_cast<double>(n) - load4(stencils.r[d] + i);
          moment += load4(stencils.w[d][n] + i) * distance * distance;
        }
        const Vec4 scale = moment > 1e-2 ? load4(m + i) / (moment * (h * h)) : Vec4{};
        const auto column = [&](int c) {
          return scale * load4(affine[static_cast<std::size_t>(c * Dim + d)] + first + i);
        };
        ScatterTerms<Dim>::spread(terms.affine[d], i, column(0), column(1), Dim == 3 ? column(Dim - 1) : Vec4{});
      }
    }
  }

  /// Adds the sums of particle `i` to its nodes. The products of one-dimensional functions are formed for the plane,
  /// then for the row, then for the node.
  template <AddedSums sums, class Nodes>
  static void add(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice, int i,
                  const Nodes& nodes) {
    if constexpr (sums.flux) return add_with_flux(s, terms, lattice, i, nodes);
    const Vec4 first = load4(terms.whole[i]), second = load4(terms.whole[i] + 4);
    [[maybe_unused]] Vec4 flux[3], affine[3];
    for (int d = 0; d < Dim; ++d) {
      if constexpr (sums.second) flux[d] = load4(terms.flux[d][i]);
      if constexpr (sums.affine) affine[d] = lattice.spacing[d] * load4(terms.affine[d][i]);
    }
    double wx[width];
    [[maybe_unused]] double gx[width], ax[width];
    for (int n = 0; n < width; ++n) {
      wx[n] = s.w[0][n][i];
      if constexpr (sums.second) gx[n] = s.g[0][n][i];
      if constexpr (sums.affine) ax[n] = wx[n] * (n - s.r[0][i]);
    }
    const Nodes around = nodes.from(s.base[i]);
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      const double wz = Dim == 3 ? s.w[Dim - 1][c][i] : 1.0;
      [[maybe_unused]] Vec4 plane = first, plane_second = second;
      [[maybe_unused]] Vec4 plane_x = flux[0], plane_y = flux[1], affine_x = affine[0], affine_y = affine[1];
      if constexpr (Dim == 3) {
        if constexpr (sums.affine) {
          plane += (c - s.r[Dim - 1][i]) * affine[2];
          affine_x = wz * affine[0], affine_y = wz * affine[1];
        }
        plane = wz * plane;
        if constexpr (sums.second) {
          plane_second = wz * second + s.g[Dim - 1][c][i] * flux[2];
          plane_x = wz * flux[0], plane_y = wz * flux[1];
        }
      }
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const double wy = s.w[1][b][i];
        [[maybe_unused]] Vec4 row, slope, row_second, spin;
        if constexpr (sums.first && !sums.affine) row = wy * plane;
        if constexpr (sums.affine) row = wy * (plane + (b - s.r[1][i]) * affine_y), spin = wy * affine_x;
        if constexpr (sums.second) row_second = wy * plane_second + s.g[1][b][i] * plane_y, slope = wy * plane_x;
        const std::ptrdiff_t of_row = 8 * (c * NodePatch::plane + b * NodePatch::row);
#pragma GCC unroll 4
        for (int a = 0; a < width; ++a) {
          double* node = around((c * width + b) * width + a, of_row + 8 * a);
          if constexpr (sums.first) {
            Vec4 sum = load4(node) + wx[a] * row;
            if constexpr (sums.affine) sum += ax[a] * spin;
            store4(node, sum);
          }
          if constexpr (sums.second) store4(node + 4, load4(node + 4) + wx[a] * row_second + gx[a] * slope);
        }
      }
    }
  }

  /// Adds a linear field and a flux (number 1 and 2 of a node) and their weight (number 0). Along each axis, a vector
  /// has the factor of the field, w (x_I - x), and that of the flux, dw/dx.
  template <class Nodes>
  static void add_with_flux(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice,
                            int i, const Nodes& nodes) {
    const Vec4 whole = load4(terms.whole[i]);
    Vec4 linear[3], factor[Dim][width];
    double w[3][width];
    for (int d = 0; d < Dim; ++d) {
      linear[d] = lattice.spacing[d] * load4(terms.affine[d][i]) + load4(terms.flux[d][i]);
      for (int n = 0; n < width; ++n) {
        w[d][n] = s.w[d][n][i];
        factor[d][n] = Vec4{0.0, w[d][n] * (n - s.r[d][i]), s.g[d][n][i], 0.0};
      }
    }
    const Nodes around = nodes.from(s.base[i]);
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      Vec4 plane = whole, plane_x = linear[0], plane_y = linear[1];
      if constexpr (Dim == 3) {
        plane = w[2][c] * whole + factor[Dim - 1][c] * linear[2];
        plane_x = w[2][c] * linear[0], plane_y = w[2][c] * linear[1];
      }
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const Vec4 row = w[1][b] * plane + factor[1][b] * plane_y, slope = w[1][b] * plane_x;
        const std::ptrdiff_t of_row = 8 * (c * NodePatch::plane + b * NodePatch::row);
#pragma GCC unroll 4
        for (int a = 0; a < width; ++a) {
          double* node = around((c * width + b) * width + a, of_row + 8 * a);
          store4(node, load4(node) + w[0][a] * row + factor[0][a] * slope);
        }
      }
    }
  }

  /// The same for particles near a crack. Not inlined, so that the loop over particles of one field is compiled as if
  /// there were no others.
  template <AddedSums sums>
  [[gnu::noinline]] static void add_by_side(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms,
                                            const Lattice<Dim>& lattice, int i, const NodesBySide& nodes) {
    add<sums>(s, terms, lattice, i, nodes);
  }
  template <GatheredSums wanted>
  [[gnu::noinline]] static void sum_by_side(const Stencils<Dim, Kernel>& s, const Lattice<Dim>& lattice, int i,
                                            const NodesBySide& nodes, GatherSums<Dim>& sums) {
    sum<wanted>(s, lattice, i, nodes, sums);
  }

  /// Interpolates the values of the nodes to particle `i`.
  template <GatheredSums wanted, class Nodes>
  static void sum(const Stencils<Dim, Kernel>& s, const Lattice<Dim>& lattice, int i, const Nodes& nodes,
                  GatherSums<Dim>& sums) {
    double wx[width];
    [[maybe_unused]] double gx[width], ax[width];
    for (int n = 0; n < width; ++n) {
      wx[n] = s.w[0][n][i];
      if constexpr (wanted.gradient) gx[n] = s.g[0][n][i];
      if constexpr (wanted.affine) ax[n] = wx[n] * (n - s.r[0][i]);
    }
    const Nodes around = nodes.from(s.base[i]);
    Vec4 value{};
    [[maybe_unused]] Vec4 second{}, lx{}, ly{}, lz{}, bx{}, by{}, bz{};
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      Vec4 plane{};
      [[maybe_unused]] Vec4 plane_second{}, plane_x{}, plane_y{}, moment_x{}, moment_y{};
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const std::ptrdiff_t of_row = 8 * (c * NodePatch::plane + b * NodePatch::row);
        const double wy = s.w[1][b][i];
        // The sum of f(a) times a vector of the nodes of the row, which begins `at` numbers after that of the node.
        const auto along = [&](const double* f, int at) {
          Vec4 total = f[0] * load4(around((c * width + b) * width, of_row) + at);
          for (int a = 1; a < width; ++a)
            total += f[a] * load4(around((c * width + b) * width + a, of_row + 8 * a) + at);
          return total;
        };
        const Vec4 row = along(wx, 0);
        plane += wy * row;
        if constexpr (wanted.second) plane_second += wy * along(wx, 4);
        if constexpr (wanted.gradient) plane_x += wy * along(gx, 0), plane_y += s.g[1][b][i] * row;
        if constexpr (wanted.affine) moment_x += wy * along(ax, 0), moment_y += (wy * (b - s.r[1][i])) * row;
      }
      if constexpr (Dim == 2) {
        value = plane, second = plane_second, lx = plane_x, ly = plane_y, bx = moment_x, by = moment_y;
      } else {
        const double wz = s.w[Dim - 1][c][i];
        value += wz * plane;
        if constexpr (wanted.second) second += wz * plane_second;
        if constexpr (wanted.gradient) lx += wz * plane_x, ly += wz * plane_y, lz += s.g[Dim - 1][c][i] * plane;
        if constexpr (wanted.affine)
          bx += wz * moment_x, by += wz * moment_y, bz += (wz * (c - s.r[Dim - 1][i])) * plane;
      }
    }
    store4(sums.whole[i % 4], value);
    if constexpr (wanted.second) store4(sums.whole[i % 4] + 4, second);
    if constexpr (wanted.gradient) {
      store4(sums.slope[0][i % 4], lx), store4(sums.slope[1][i % 4], ly);
      if constexpr (Dim == 3) store4(sums.slope[Dim - 1][i % 4], lz);
    }
    if constexpr (wanted.affine) {
      const auto& h = lattice.spacing;
      store4(sums.moment[0][i % 4], h[0] * bx), store4(sums.moment[1][i % 4], h[1] * by);
      if constexpr (Dim == 3) store4(sums.moment[Dim - 1][i % 4], h[Dim - 1] * bz);
    }
  }
};

}  // namespace tribo
