// SPDX-License-Identifier: MIT
/// The sums over the stencil of one particle, for kernels that are products of one-dimensional shape functions. They
/// use vectors of the components of a node.
#pragma once

#include "solver/transfer/cut_patches.hpp"
#include "solver/transfer/particle_update.hpp"
#include "solver/transfer/scatter_terms.hpp"
#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer_sums.hpp"

#include <array>
#include <type_traits>

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

  /// Adds the sums of particle `i` to its nodes: the values of the particle times w, and the coefficients of linear
  /// fields times w (x_I - x), or fluxes times dw/dx, or both in different components.
  template <AddedSums sums, class Nodes>
  static void add(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice, int i,
                  const Nodes& nodes) {
    const auto linear = [&](int d) { return lattice.spacing[d] * load4(terms.affine[d][i]); };
    const auto flux = [&](int d) { return load4(terms.flux[d][i]); };
    const auto distance = [&](int d, int n) { return s.w[d][n][i] * (n - s.r[d][i]); };
    const auto slope = [&](int d, int n) { return s.g[d][n][i]; };
    const auto both = [&](int d, int n) { return Wide::join(distance(d, n) - Vec4{}, slope(d, n) - Vec4{}); };
    const auto none = [](int, int) { return Nothing{}; };
    const double* whole = terms.whole[i];
    if constexpr (sums.flux) {  // in the components 1 and 2
      add_products(
          s, i, load4(whole), [&](int d) { return linear(d) + flux(d); },
          [&](int d, int n) {
            return Vec4{0.0, distance(d, n), slope(d, n), 0.0};
          },
          nodes, 0);
    } else if constexpr (sums.first && sums.second && sums.affine) {
      add_products(
          s, i, Wide::load(whole), [&](int d) { return Wide::join(linear(d), flux(d)); }, both, nodes, 0);
    } else if constexpr (sums.first && sums.second) {
      add_products(
          s, i, Wide::load(whole), [&](int d) { return Upper::from(flux(d)); }, slope, nodes, 0);
    } else if constexpr (sums.second) {
      add_products(s, i, load4(whole + 4), flux, slope, nodes, 4);
    } else if constexpr (sums.affine) {
      add_products(s, i, load4(whole), linear, distance, nodes, 0);
    } else {
      add_products(
          s, i, load4(whole), [](int) { return Nothing{}; }, none, nodes, 0);
    }
  }

  /// Adds `whole` w + sum_d `gradient`(d) k_d to the nodes of particle `i`, from their number `at`. k_d is the product
  /// of `factor`(d, n) for the n-th node along axis d and of w along the other axes. The products are formed for the
  /// plane, then for the row, then for the node.
  template <class Whole, class Gradient, class Factor, class Nodes>
  static void add_products(const Stencils<Dim, Kernel>& s, int i, Whole whole, Gradient gradient, Factor factor,
                           const Nodes& nodes, int at) {
    const auto along_x = gradient(0), along_y = gradient(1);
    double wx[width];
    std::array<decltype(factor(0, 0)), width> kx;
    for (int n = 0; n < width; ++n) wx[n] = s.w[0][n][i], kx[static_cast<std::size_t>(n)] = factor(0, n);
    const Nodes around = nodes.from(s.base[i]);
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      Whole plane = whole;
      auto plane_x = along_x, plane_y = along_y;
      if constexpr (Dim == 3) {
        const double wz = s.w[Dim - 1][c][i];
        plane = wz * whole + factor(2, c) * gradient(2);
        plane_x = wz * along_x, plane_y = wz * along_y;
      }
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const double wy = s.w[1][b][i];
        const Whole row = wy * plane + factor(1, b) * plane_y;
        const auto row_x = wy * plane_x;
        const std::ptrdiff_t of_row = 8 * (c * NodePatch::plane + b * NodePatch::row);
#pragma GCC unroll 4
        for (int a = 0; a < width; ++a) {
          double* node = around((c * width + b) * width + a, of_row + 8 * a) + at;
          store_all(node, load_as<Whole>(node) + wx[a] * row + kx[static_cast<std::size_t>(a)] * row_x);
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
    using Value = std::conditional_t<wanted.second, Wide, Vec4>;
    double wx[width];
    [[maybe_unused]] double gx[width], ax[width];
    for (int n = 0; n < width; ++n) {
      wx[n] = s.w[0][n][i];
      if constexpr (wanted.gradient) gx[n] = s.g[0][n][i];
      if constexpr (wanted.affine) ax[n] = wx[n] * (n - s.r[0][i]);
    }
    const Nodes around = nodes.from(s.base[i]);
    Value value{};
    [[maybe_unused]] Vec4 lx{}, ly{}, lz{}, bx{}, by{}, bz{};
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      Value plane{};
      [[maybe_unused]] Vec4 plane_x{}, plane_y{}, moment_x{}, moment_y{};
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const std::ptrdiff_t of_row = 8 * (c * NodePatch::plane + b * NodePatch::row);
        const double wy = s.w[1][b][i];
        // The sum of f(a) times a vector of the nodes of the row.
        const auto along = [&]<class Vector>(const double* f, Vector) {
          Vector total = f[0] * load_as<Vector>(around((c * width + b) * width, of_row));
          for (int a = 1; a < width; ++a)
            total = total + f[a] * load_as<Vector>(around((c * width + b) * width + a, of_row + 8 * a));
          return total;
        };
        const Value row = along(wx, Value{});
        const Vec4 first = low_half(row);
        plane = plane + wy * row;
        if constexpr (wanted.gradient) plane_x += wy * along(gx, Vec4{}), plane_y += s.g[1][b][i] * first;
        if constexpr (wanted.affine) moment_x += wy * along(ax, Vec4{}), moment_y += (wy * (b - s.r[1][i])) * first;
      }
      if constexpr (Dim == 2) {
        value = plane, lx = plane_x, ly = plane_y, bx = moment_x, by = moment_y;
      } else {
        const double wz = s.w[Dim - 1][c][i];
        const Vec4 first = low_half(plane);
        value = value + wz * plane;
        if constexpr (wanted.gradient) lx += wz * plane_x, ly += wz * plane_y, lz += s.g[Dim - 1][c][i] * first;
        if constexpr (wanted.affine)
          bx += wz * moment_x, by += wz * moment_y, bz += (wz * (c - s.r[Dim - 1][i])) * first;
      }
    }
    store_all(sums.whole[i % 4], value);
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
