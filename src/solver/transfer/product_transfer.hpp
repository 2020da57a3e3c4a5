// SPDX-License-Identifier: MIT
/// Transfers for kernels that are products of one-dimensional shape functions.
///
///   scatter   m_I = sum_p w_Ip m_p,   (m v)_I = sum_p w_Ip m_p (v_p + C_p (x_I - x_p)),
///             f_I = sum_p w_Ip f_p - V_p sigma_p grad w_Ip
///   gather    S v = sum_I w_Ip v_I,   L_p = sum_I v_I (x) grad w_Ip
///
/// A bin uses a small dense patch of nodes with constant strides. Shape functions and particle updates are computed
/// for batches in loops that the compiler vectorises; the sums over the stencil use vectors of the components of a
/// node.
#pragma once

#include "base/parallel.hpp"
#include "solver/transfer/cut_patches.hpp"
#include "solver/transfer/particle_update.hpp"
#include "solver/transfer/scatter_terms.hpp"
#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer.hpp"

#include <algorithm>

namespace tribo {

template <int Dim, class Kernel>
class ProductTransfers final : public Transfers<Dim> {
 public:
  static constexpr int width = Kernel::width;
  using NodePatch = Patch<Dim, width>;

  double shift() const override { return Kernel::shift; }
  int colours_per_axis() const override { return width + 1 <= block_edge<Dim> ? 2 : 3; }

  int stencil_width() const override { return width; }

  void lowest_nodes(Body<Dim>& body, const Lattice<Dim>& lattice, const Bin& bin,
                    std::vector<Index<Dim>>& lowest) const override {
    const auto block = lattice.block_at(bin.block);
    const auto half = half_sizes(body);
    Stencils<Dim, Kernel> stencils;
    lowest.resize(bin.end - bin.begin);
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      stencils.compute(lattice, block, body.particles.x(), first, count, half, body.uniform_half_size);
      for (int i = 0; i < count; ++i)
        lowest[first - bin.begin + static_cast<std::uint32_t>(i)] = NodePatch::node(block, stencils.base[i]);
    }
  }

  void scatter(Body<Dim>& body, const Target<Dim>& target, Scatter what, bool from_start, bool axisymmetric,
               const std::vector<char>* only) const override {
    const bool affine =
        what == Scatter::heat || (body.affine && (what == Scatter::momentum || what == Scatter::momentum_and_force));
    const bool force = uses_gradients(what);
    for (std::size_t c = 0; c < body.bins.colours().size(); ++c) {
      const auto& colour = body.bins.colours()[c];
      const auto before = [&](std::ptrdiff_t k) { return body.bins.before(c, static_cast<std::size_t>(k)); };
      parallel_for_weighted(static_cast<std::ptrdiff_t>(colour.size()), before, [&](std::ptrdiff_t k) {
        const Bin& bin = body.bins.list()[colour[static_cast<std::size_t>(k)]];
        if (only && !(*only)[static_cast<std::size_t>(bin.block)]) return;
        const CutBin* cut = body.cut_bin(colour[static_cast<std::size_t>(k)]);
        if (force && affine)
          scatter_bin<true, true>(body, target, bin, cut, what, from_start, axisymmetric);
        else if (force)
          scatter_bin<true, false>(body, target, bin, cut, what, from_start, axisymmetric);
        else if (affine)
          scatter_bin<false, true>(body, target, bin, cut, what, from_start, axisymmetric);
        else
          scatter_bin<false, false>(body, target, bin, cut, what, from_start, axisymmetric);
      });
    }
  }

  GatherResult gather(Body<Dim>& body, const Target<Dim>& target, const Gather& what) const override {
    thread_local GatherCollector of_thread;
    GatherCollector& collector = of_thread;  // of this one, in the loop below
    collector.start();
    const auto& bins = body.bins.list();
    const auto before = [&](std::ptrdiff_t k) { return body.bins.before(static_cast<std::size_t>(k)); };
    parallel_for_weighted(static_cast<std::ptrdiff_t>(bins.size()), before, [&](std::ptrdiff_t k) {
      auto& result = collector.mine();
      const Bin& bin = bins[static_cast<std::size_t>(k)];
      const CutBin* cut = body.cut_bin(static_cast<std::size_t>(k));
      if (what.task == GatherTask::filtered_velocity || what.task == GatherTask::temperature_residual ||
          what.task == GatherTask::cell_mean)
        gather_bin<false, false>(body, target, bin, cut, what, result);
      else if (body.affine && what.move)
        gather_bin<true, true>(body, target, bin, cut, what, result);
      else
        gather_bin<true, false>(body, target, bin, cut, what, result);
    });
    return collector.total();
  }

 private:
  using Across = CutPatches<Dim, width>;

  static std::array<const double*, Dim> half_sizes(const Body<Dim>& body) {
    if (Kernel::sized && body.half_size) return body.particles[body.half_size];
    return {};
  }

  template <bool Force, bool Affine>
  void scatter_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, Scatter what,
                   bool from_start, bool axisymmetric) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto block = map.lattice().block_at(bin.block);
    const auto x = from_start ? body.particles[body.start] : body.particles.x();
    const auto half = half_sizes(body);
    NodePatch patch;
    patch.clear();
    Across across(cut != nullptr);
    Stencils<Dim, Kernel> stencils;
    ScatterTerms<Dim> terms;
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      stencils.compute(map.lattice(), block, x, first, count, half, body.uniform_half_size);
      terms.template prepare<Force>(body, first, count, what, axisymmetric);
      if (Affine && what != Scatter::heat) prepare_affine(body, map.lattice(), stencils, first, count, terms);
      for (int i = 0; i < count; ++i) {
        if (i % 8 == 0) fetch_ahead(body.read_by_scatter, first + static_cast<std::uint32_t>(batch + i));
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        if (sides)
          add_by_side<Force, Affine>(stencils, terms, map.lattice(), i, sides, across.data(patch));
        else
          add<Force, Affine>(stencils, terms, map.lattice(), i, patch.data);
      }
    }
    patch.add_to(map.neighbours(bin.block), target.nodes[0]);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.add_to(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
  }

  // C = B D^-1 with D = sum w (x_i - x)(x_i - x)^T, diagonal for product kernels. Where D vanishes (a point on a node
  // of the linear kernel), round-off would be amplified, so the affine part is set to zero.
  static void prepare_affine(Body<Dim>& body, const Lattice<Dim>& lattice, const Stencils<Dim, Kernel>& stencils,
                             std::uint32_t first, int count, ScatterTerms<Dim>& terms) {
    const double* m = body.particles.mass() + first;
    const auto affine = body.particles[body.affine];
    for (int d = 0; d < Dim; ++d)
      for (int i = 0; i < count; ++i) {
        double moment = 0.0;
        for (int n = 0; n < width; ++n) {
          const double distance = (n - stencils.r[d][i]) * lattice.spacing[d];
          moment += stencils.w[d][n][i] * distance * distance;
        }
        const double h = lattice.spacing[d];
        const double scale = moment > 1e-2 * h * h ? m[i] / moment : 0.0;
        double* to = terms.affine[d][i];
        to[0] = 0.0, to[3] = 0.0;
        for (int c = 0; c < Dim; ++c)
          to[1 + c] = scale * affine[static_cast<std::size_t>(c * Dim + d)][first + static_cast<std::uint32_t>(i)];
      }
  }

  template <bool Force, bool Affine>
  static void add(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice, int i,
                  double* data) {
    const Wide whole = Wide::load(terms.whole[i]);
    [[maybe_unused]] Upper flux[3];
    if constexpr (Force)
      for (int d = 0; d < Dim; ++d) flux[d] = Upper::from(load4(terms.flux[d][i]));
    double wx[width];
    [[maybe_unused]] double gx[width], ax[width];
    for (int n = 0; n < width; ++n) {
      wx[n] = s.w[0][n][i];
      if constexpr (Force) gx[n] = s.g[0][n][i];
      if constexpr (Affine) ax[n] = wx[n] * (n - s.r[0][i]) * lattice.spacing[0];
    }
    double* base = data + s.base[i];
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      // The products of one-dimensional functions are formed for the plane, then for the row, then for the node.
      const double wz = Dim == 3 ? s.w[Dim - 1][c][i] : 1.0;
      Wide plane = Dim == 3 ? wz * whole : whole;
      [[maybe_unused]] Upper plane_x = flux[0], plane_y = flux[1];
      if constexpr (Force && Dim == 3) {
        plane = plane + s.g[Dim - 1][c][i] * flux[2];
        plane_x = wz * flux[0], plane_y = wz * flux[1];
      }
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const double wy = s.w[1][b][i];
        [[maybe_unused]] const double wyz = wy * wz;
        Wide row = wy * plane;
        [[maybe_unused]] Upper slope;
        if constexpr (Force) {
          row = row + s.g[1][b][i] * plane_y;
          slope = wy * plane_x;
        }
        [[maybe_unused]] Wide spin;
        if constexpr (Affine) {
          Vec4 low = (b - s.r[1][i]) * lattice.spacing[1] * load4(terms.affine[1][i]);
          if constexpr (Dim == 3)
            low += (c - s.r[Dim - 1][i]) * lattice.spacing[Dim - 1] * load4(terms.affine[Dim - 1][i]);
          row = row + Wide::join(wyz * low, Vec4{});
          spin = Wide::join(wyz * load4(terms.affine[0][i]), Vec4{});
        }
        double* node = base + 8 * (c * NodePatch::plane + b * NodePatch::row);
#pragma GCC unroll 4
        for (int a = 0; a < width; ++a) {
          Wide sum = Wide::load(node + 8 * a) + wx[a] * row;
          if constexpr (Force) sum = sum + gx[a] * slope;
          if constexpr (Affine) sum = sum + ax[a] * spin;
          sum.store(node + 8 * a);
        }
      }
    }
  }

  template <bool Gradient, bool Affine>
  void gather_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, const Gather& what,
                  GatherResult& result) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto block = map.lattice().block_at(bin.block);
    const auto x = what.from_start ? body.particles[body.start] : body.particles.x();
    const auto half = half_sizes(body);
    NodePatch patch;
    patch.load(map.neighbours(bin.block), target.nodes[0]);
    Across across(cut != nullptr);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.load(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
    Stencils<Dim, Kernel> stencils;
    GatherSums<Dim> sums;
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      stencils.compute(map.lattice(), block, x, first, count, half, body.uniform_half_size);
      for (int i = 0; i < count; i += 4) {
        if (i % 8 == 0) fetch_ahead(body.read_by_gather, first + static_cast<std::uint32_t>(batch + i));
        for (int k = 0; k < 4 && i + k < count; ++k) {
          const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i + k)) : nullptr;
          if (sides)
            sum_by_side<Gradient, Affine>(stencils, map.lattice(), i + k, sides, across.data(patch), sums);
          else
            sum<Gradient, Affine>(stencils, map.lattice(), i + k, patch.data, sums);
        }
        sums.template transpose<Gradient, Affine>(i);
      }
      update_particles(body, map.lattice(), first, count, what, sums, result);
    }
  }

  template <bool Gradient, bool Affine>
  static void sum(const Stencils<Dim, Kernel>& s, const Lattice<Dim>& lattice, int i, const double* data,
                  GatherSums<Dim>& sums) {
    double wx[width];
    [[maybe_unused]] double gx[width], ax[width];
    for (int n = 0; n < width; ++n) {
      wx[n] = s.w[0][n][i];
      if constexpr (Gradient) gx[n] = s.g[0][n][i];
      if constexpr (Affine) ax[n] = wx[n] * (n - s.r[0][i]) * lattice.spacing[0];
    }
    const double* base = data + s.base[i];
    Wide value = Wide::zero();
    Vec4 lx{}, ly{};
    [[maybe_unused]] Vec4 lz{}, bx{}, by{}, bz{};
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      const double wz = Dim == 3 ? s.w[Dim - 1][c][i] : 1.0;
      Wide plane = Wide::zero();
      [[maybe_unused]] Vec4 plane_x{}, plane_y{};
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const double* node = base + 8 * (c * NodePatch::plane + b * NodePatch::row);
        const double wy = s.w[1][b][i];
        [[maybe_unused]] const double wyz = wy * wz;
        Wide along = wx[0] * Wide::load(node);
        for (int a = 1; a < width; ++a) along = along + wx[a] * Wide::load(node + 8 * a);
        plane = plane + wy * along;
        if constexpr (Gradient) {
          Vec4 slope = gx[0] * load4(node);
          for (int a = 1; a < width; ++a) slope += gx[a] * load4(node + 8 * a);
          plane_x += wy * slope;
          plane_y += s.g[1][b][i] * along.low();
        }
        if constexpr (Affine) {
          Vec4 moment = ax[0] * load4(node);
          for (int a = 1; a < width; ++a) moment += ax[a] * load4(node + 8 * a);
          bx += wyz * moment;
          by += wyz * (b - s.r[1][i]) * lattice.spacing[1] * along.low();
          if constexpr (Dim == 3) bz += wyz * (c - s.r[2][i]) * lattice.spacing[2] * along.low();
        }
      }
      if constexpr (Dim == 2) {
        value = plane, lx = plane_x, ly = plane_y;
      } else {
        value = value + wz * plane;
        if constexpr (Gradient) lx += wz * plane_x, ly += wz * plane_y, lz += s.g[Dim - 1][c][i] * plane.low();
      }
    }
    value.store(sums.whole[i % 4]);
    if constexpr (Gradient) {
      store4(sums.slope[0][i % 4], lx), store4(sums.slope[1][i % 4], ly);
      if constexpr (Dim == 3) store4(sums.slope[Dim - 1][i % 4], lz);
    }
    if constexpr (Affine) {
      store4(sums.moment[0][i % 4], bx), store4(sums.moment[1][i % 4], by);
      if constexpr (Dim == 3) store4(sums.moment[Dim - 1][i % 4], bz);
    }
  }

  /// Calls f(n, offset in a patch, shape function, its gradient, distance [cells]) for the nodes of a stencil, x
  /// fastest.
  template <class F>
  static void each_stencil_node(const Stencils<Dim, Kernel>& s, int i, F&& f) {
    int n = 0;
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c)
      for (int b = 0; b < width; ++b)
        for (int a = 0; a < width; ++a, ++n) {
          const int at[3] = {a, b, c};
          double w = 1.0;
          std::array<double, Dim> slope, distance;
          for (int d = 0; d < Dim; ++d) {
            const auto k = static_cast<std::size_t>(d);
            w *= s.w[d][at[d]][i], slope[k] = s.g[d][at[d]][i], distance[k] = at[d] - s.r[d][i];
            for (int e = 0; e < Dim; ++e)
              if (e != d) slope[k] *= s.w[e][at[e]][i];
          }
          f(n, s.base[i] + 8 * (c * NodePatch::plane + b * NodePatch::row + a), w, slope, distance);
        }
  }

  template <bool Force, bool Affine>
  static void add_by_side(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice,
                          int i, const std::uint8_t* sides, const std::array<double*, 4>& data) {
    const Wide whole = Wide::load(terms.whole[i]);
    each_stencil_node(
        s, i, [&](int n, int at, double w, [[maybe_unused]] const auto& slope, [[maybe_unused]] const auto& distance) {
          double* node = data[sides[n]] + at;
          Wide sum = Wide::load(node) + w * whole;
          for (std::size_t d = 0; d < Dim; ++d) {
            if constexpr (Force) sum = sum + slope[d] * Upper::from(load4(terms.flux[d][i]));
            if constexpr (Affine)
              sum = sum + Wide::join(w * distance[d] * lattice.spacing[static_cast<Eigen::Index>(d)] *
                                         load4(terms.affine[d][i]),
                                     Vec4{});
          }
          sum.store(node);
        });
  }

  template <bool Gradient, bool Affine>
  static void sum_by_side(const Stencils<Dim, Kernel>& s, const Lattice<Dim>& lattice, int i, const std::uint8_t* sides,
                          const std::array<double*, 4>& data, GatherSums<Dim>& sums) {
    Wide value = Wide::zero();
    [[maybe_unused]] Vec4 gradient[Dim] = {}, moment[Dim] = {};
    each_stencil_node(
        s, i, [&](int n, int at, double w, [[maybe_unused]] const auto& slope, [[maybe_unused]] const auto& distance) {
          const Wide node = Wide::load(data[sides[n]] + at);
          value = value + w * node;
          for (std::size_t d = 0; d < Dim; ++d) {
            if constexpr (Gradient) gradient[d] += slope[d] * node.low();
            if constexpr (Affine)
              moment[d] += w * distance[d] * lattice.spacing[static_cast<Eigen::Index>(d)] * node.low();
          }
        });
    value.store(sums.whole[i % 4]);
    for (std::size_t d = 0; d < Dim; ++d) {
      if constexpr (Gradient) store4(sums.slope[d][i % 4], gradient[d]);
      if constexpr (Affine) store4(sums.moment[d][i % 4], moment[d]);
    }
  }
};

}  // namespace tribo
