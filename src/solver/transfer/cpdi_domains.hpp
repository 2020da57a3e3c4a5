// SPDX-License-Identifier: MIT
/// The corners of the particle domains of a batch, for linear CPDI.
#pragma once

#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer.hpp"

#include <algorithm>

namespace tribo {

/// The domains of a batch of particles in the patch of their block, one array over the particles for each number, so
/// that the compiler vectorises the loops. Domains that reach beyond the limit are scaled.
template <int Dim>
struct CpdiDomains {
  static constexpr int width = 4;  ///< nodes of a stencil along an axis
  using NodePatch = Patch<Dim, width>;
  static constexpr int corners = 1 << Dim;
  static constexpr int stride[3] = {8, 8 * NodePatch::row, 8 * NodePatch::plane};

  alignas(64) int base[batch_lanes];                   ///< offset of the lowest node in the patch, in doubles
  alignas(64) double at[Dim][batch_lanes];             ///< position of the particle from the lowest node [cells]
  alignas(64) int cell[corners][Dim][batch_lanes];     ///< lowest node of the cell of a corner, from the base
  alignas(64) double part[corners][Dim][batch_lanes];  ///< position of a corner in its cell [cells]
  /// Gradient of the natural coordinate k along axis d, over the number of corners [1/length].
  alignas(64) double slope[Dim][Dim][batch_lanes];

  static constexpr double sign(int corner, int axis) { return corner >> axis & 1 ? 1.0 : -1.0; }

  /// `limit`: largest distance of a corner from the particle along an axis [cells].
  void compute(Body<Dim>& body, const Lattice<Dim>& lattice, const Index<Dim>& block,
               const typename Particles<Dim>::Vector& x, std::uint32_t first, int count, double limit) {
    alignas(64) double R[Dim][Dim][batch_lanes];  // half edges [cells]
    half_edges(body, lattice, first, count, R);
    for (int i = 0; i < count; ++i) {
      double reach = 0.0;
      for (int r = 0; r < Dim; ++r) {
        double sum = 0.0;
        for (int c = 0; c < Dim; ++c) sum += std::abs(R[r][c][i]);
        reach = std::max(reach, sum);
      }
      const double scale = reach > limit ? limit / reach : 1.0;
      for (int r = 0; r < Dim; ++r)
        for (int c = 0; c < Dim; ++c) R[r][c][i] *= scale;
    }
    invert(lattice, count, R);
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const double inverse = 1.0 / lattice.spacing[d];
      const double origin = lattice.origin[d] * inverse + (block[k] * block_edge<Dim> - 1);
      const double* position = x[k] + first;
      for (int i = 0; i < count; ++i) {
        const double cells = position[i] * inverse - origin;
        const int lowest = static_cast<int>(cells - 1.0);
        at[d][i] = cells - lowest;
        base[i] = (d == 0 ? 0 : base[i]) + lowest * stride[d];
      }
      for (int c = 0; c < corners; ++c)
        for (int i = 0; i < count; ++i) {
          double corner = at[d][i];
          for (int e = 0; e < Dim; ++e) corner += sign(c, e) * R[d][e][i];
          const int node = std::clamp(static_cast<int>(corner), 0, 2);
          cell[c][d][i] = node, part[c][d][i] = corner - node;
        }
    }
  }

  /// Calls f(offset in the patch, index in the stencil, hat function, vector from the particle to the node) for the
  /// nodes around a corner of particle i.
  template <class F>
  void each_node(const Lattice<Dim>& lattice, int i, int corner, F&& f) const {
    for (int n = 0; n < corners; ++n) {
      double hat = 1.0;
      int index = 0, offset = base[i];
      std::array<double, Dim> distance;
      for (int d = 0; d < Dim; ++d) {
        const int up = n >> d & 1, node = cell[corner][d][i] + up;
        hat *= up ? part[corner][d][i] : 1.0 - part[corner][d][i];
        index += node << (2 * d), offset += node * stride[d];
        distance[static_cast<std::size_t>(d)] = (node - at[d][i]) * lattice.spacing[d];
      }
      f(offset, index, hat, distance);
    }
  }

  /// D = sum w (x_I - x)(x_I - x)^T: the mean over the corners of the products of their distances and, on the diagonal,
  /// of t (1 - t) h^2 of a hat function at t within its cell [length^2].
  Mat<Dim> second_moments(const Lattice<Dim>& lattice, int i) const {
    Mat<Dim> D = Mat<Dim>::Zero();
    for (int c = 0; c < corners; ++c) {
      Vec<Dim> r;
      for (int d = 0; d < Dim; ++d) {
        const double t = part[c][d][i], h = lattice.spacing[d];
        r[d] = (cell[c][d][i] + t - at[d][i]) * h;
        D(d, d) += t * (1.0 - t) * h * h;
      }
      D += r * r.transpose();
    }
    return D / corners;
  }

 private:
  static void half_edges(Body<Dim>& body, const Lattice<Dim>& lattice, std::uint32_t first, int count,
                         double (&R)[Dim][Dim][batch_lanes]) {
    const auto F = body.particles[body.domain];
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) {
        double* __restrict to = R[r][c];
        const double inverse = 1.0 / lattice.spacing[r];
        const auto column = [&](const auto& of, int row, int col) {
          return of[static_cast<std::size_t>(row * Dim + col)] + first;
        };
        if (body.half_axes) {
          const auto axes = body.particles[body.half_axes];
          for (int i = 0; i < count; ++i) to[i] = 0.0;
          for (int k = 0; k < Dim; ++k) {
            const double *f = column(F, r, k), *a = column(axes, k, c);
            for (int i = 0; i < count; ++i) to[i] += inverse * f[i] * a[i];
          }
          continue;
        }
        const double* f = column(F, r, c);
        if (body.half_size) {
          const double* half = body.particles[body.half_size][static_cast<std::size_t>(c)] + first;
          for (int i = 0; i < count; ++i) to[i] = inverse * f[i] * half[i];
        } else {
          const double half = inverse * body.uniform_half_size[c];
          for (int i = 0; i < count; ++i) to[i] = half * f[i];
        }
      }
  }

  void invert(const Lattice<Dim>& lattice, int count, const double (&R)[Dim][Dim][batch_lanes]) {
    double inverse[3];
    for (int d = 0; d < Dim; ++d) inverse[d] = 1.0 / (lattice.spacing[d] * corners);
    for (int i = 0; i < count; ++i) {
      if constexpr (Dim == 2) {
        const double det = 1.0 / (R[0][0][i] * R[1][1][i] - R[0][1][i] * R[1][0][i]);
        slope[0][0][i] = det * R[1][1][i] * inverse[0], slope[0][1][i] = -det * R[0][1][i] * inverse[1];
        slope[1][0][i] = -det * R[1][0][i] * inverse[0], slope[1][1][i] = det * R[0][0][i] * inverse[1];
      } else {
        const auto cofactor = [&](int r, int c) {
          const int a = (r + 1) % 3, b = (r + 2) % 3, e = (c + 1) % 3, f = (c + 2) % 3;
          return R[a][e][i] * R[b][f][i] - R[a][f][i] * R[b][e][i];
        };
        const double c0 = cofactor(0, 0), c1 = cofactor(0, 1), c2 = cofactor(0, 2);
        const double det = 1.0 / (R[0][0][i] * c0 + R[0][1][i] * c1 + R[0][2][i] * c2);
        for (int k = 0; k < 3; ++k)
          for (int d = 0; d < 3; ++d) slope[k][d][i] = det * cofactor(d, k) * inverse[d];
      }
    }
  }
};

}  // namespace tribo
