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
#include "solver/transfer/transfer_sums.hpp"

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
    with_added_sums(what, static_cast<bool>(body.affine), [&](auto sums) {
      for (std::size_t c = 0; c < body.bins.colours().size(); ++c) {
        const auto& colour = body.bins.colours()[c];
        const auto before = [&](std::ptrdiff_t k) { return body.bins.before(c, static_cast<std::size_t>(k)); };
        parallel_for_weighted(static_cast<std::ptrdiff_t>(colour.size()), before, [&](std::ptrdiff_t k) {
          const Bin& bin = body.bins.list()[colour[static_cast<std::size_t>(k)]];
          if (only && !(*only)[static_cast<std::size_t>(bin.block)]) return;
          const CutBin* cut = body.cut_bin(colour[static_cast<std::size_t>(k)]);
          scatter_bin<sums()>(body, target, bin, cut, what, from_start, axisymmetric);
        });
      }
    });
  }

  GatherResult gather(Body<Dim>& body, const Target<Dim>& target, const Gather& what) const override {
    thread_local GatherCollector of_thread;
    GatherCollector& collector = of_thread;  // of this one, in the loop below
    collector.start();
    const auto& bins = body.bins.list();
    const auto before = [&](std::ptrdiff_t k) { return body.bins.before(static_cast<std::size_t>(k)); };
    with_gathered_sums(what, static_cast<bool>(body.affine), [&](auto sums) {
      parallel_for_weighted(static_cast<std::ptrdiff_t>(bins.size()), before, [&](std::ptrdiff_t k) {
        const CutBin* cut = body.cut_bin(static_cast<std::size_t>(k));
        gather_bin<sums()>(body, target, bins[static_cast<std::size_t>(k)], cut, what, collector.mine());
      });
    });
    return collector.total();
  }

  GatherResult gather_and_scatter(Body<Dim>& body, const Target<Dim>& from, const Gather& what, const Target<Dim>& to,
                                  Scatter sums, bool axisymmetric) const override {
    thread_local GatherCollector of_thread;
    GatherCollector& collector = of_thread;  // of this one, in the loops below
    collector.start();
    const auto in_one_pass = [&](auto gathered, auto added) {
      for (std::size_t c = 0; c < body.bins.colours().size(); ++c) {
        const auto& colour = body.bins.colours()[c];
        const auto before = [&](std::ptrdiff_t k) { return body.bins.before(c, static_cast<std::size_t>(k)); };
        parallel_for_weighted(static_cast<std::ptrdiff_t>(colour.size()), before, [&](std::ptrdiff_t k) {
          const Bin& bin = body.bins.list()[colour[static_cast<std::size_t>(k)]];
          const CutBin* cut = body.cut_bin(colour[static_cast<std::size_t>(k)]);
          if (!cut)
            return pass_through_bin<gathered(), added()>(body, from, what, to, sums, axisymmetric, bin,
                                                         collector.mine());
          gather_bin<gathered()>(body, from, bin, cut, what, collector.mine());
          scatter_bin<added()>(body, to, bin, cut, sums, what.move || what.from_start, axisymmetric);
        });
      }
    };
    if (!with_sums_of_both(what, sums, static_cast<bool>(body.affine), in_one_pass))
      return Transfers<Dim>::gather_and_scatter(body, from, what, to, sums, axisymmetric);
    return collector.total();
  }

 private:
  using Across = CutPatches<Dim, width>;

  static std::array<const double*, Dim> half_sizes(const Body<Dim>& body) {
    if (Kernel::sized && body.half_size) return body.particles[body.half_size];
    return {};
  }

  template <AddedSums sums>
  void scatter_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, Scatter what,
                   bool from_start, bool axisymmetric) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto block = map.lattice().block_at(bin.block);
    const auto x = from_start ? body.particles[body.start] : body.particles.x();
    const auto half = half_sizes(body);
    NodePatch patch;
    patch.clear();
    Across across(cut, target);
    const std::array<double*, 4> data = across.data(patch);
    Stencils<Dim, Kernel> stencils;
    ScatterTerms<Dim> terms;
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      stencils.compute(map.lattice(), block, x, first, count, half, body.uniform_half_size);
      terms.template prepare<sums.second>(body, first, count, what, axisymmetric);
      if (sums.affine && what != Scatter::heat) prepare_affine(body, map.lattice(), stencils, first, count, terms);
      for (int i = 0; i < count; ++i) {
        if (i % 8 == 0) fetch_ahead(body.read_by_scatter, first + static_cast<std::uint32_t>(batch + i));
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        if (sides)
          add_by_side<sums>(stencils, terms, map.lattice(), i, NodesBySide{data, sides});
        else
          add<sums>(stencils, terms, map.lattice(), i, NodesOfOneField{patch.data});
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

  // The products of one-dimensional functions are formed for the plane, then for the row, then for the node.
  // `nodes`: NodesOfOneField or NodesBySide.
  template <AddedSums sums, class Nodes>
  static void add(const Stencils<Dim, Kernel>& s, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice, int i,
                  const Nodes& nodes) {
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
    const std::ptrdiff_t base = s.base[i];
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
        const std::ptrdiff_t of_row = base + 8 * (c * NodePatch::plane + b * NodePatch::row);
#pragma GCC unroll 4
        for (int a = 0; a < width; ++a) {
          double* node = nodes((c * width + b) * width + a, of_row + 8 * a);
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

  // Not inlined, so that the loop over particles of one field is compiled as if there were no others.
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

  template <GatheredSums wanted>
  void gather_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, const Gather& what,
                  GatherResult& result) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto block = map.lattice().block_at(bin.block);
    const auto x = what.from_start ? body.particles[body.start] : body.particles.x();
    const auto half = half_sizes(body);
    NodePatch patch;
    patch.load(map.neighbours(bin.block), target.nodes[0]);
    Across across(cut, target);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.load(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
    const std::array<double*, 4> data = across.data(patch);
    Stencils<Dim, Kernel> stencils;
    GatherSums<Dim> sums;
    if constexpr (!wanted.second) std::fill_n(sums.acceleration[0], Dim * batch_lanes, 0.0);
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      stencils.compute(map.lattice(), block, x, first, count, half, body.uniform_half_size);
      for (int i = 0; i < count; i += 4) {
        if (i % 8 == 0) fetch_ahead(body.read_by_gather, first + static_cast<std::uint32_t>(batch + i));
        for (int k = 0; k < 4 && i + k < count; ++k) {
          const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i + k)) : nullptr;
          if (sides)
            sum_by_side<wanted>(stencils, map.lattice(), i + k, NodesBySide{data, sides}, sums);
          else
            sum<wanted>(stencils, map.lattice(), i + k, NodesOfOneField{patch.data}, sums);
        }
        sums.template transpose<wanted.second, wanted.gradient, wanted.affine>(i);
      }
      update_particles(body, map.lattice(), first, count, what, sums, result);
    }
  }

  // A gather and a scatter of a bin that no crack cuts, with shape functions that are evaluated once.
  template <GatheredSums wanted, AddedSums added>
  void pass_through_bin(Body<Dim>& body, const Target<Dim>& from, const Gather& what, const Target<Dim>& to,
                        Scatter to_add, bool axisymmetric, const Bin& bin, GatherResult& result) const {
    const BlockMap<Dim>& map = *from.map[0];
    const auto block = map.lattice().block_at(bin.block);
    const auto neighbours = map.neighbours(bin.block);
    const auto x = what.from_start ? body.particles[body.start] : body.particles.x();
    const auto half = half_sizes(body);
    NodePatch read, written;
    read.load(neighbours, from.nodes[0]);
    written.clear();
    Stencils<Dim, Kernel> stencils;
    GatherSums<Dim> sums;
    ScatterTerms<Dim> terms;
    if constexpr (!wanted.second) std::fill_n(sums.acceleration[0], Dim * batch_lanes, 0.0);
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      stencils.compute(map.lattice(), block, x, first, count, half, body.uniform_half_size);
      for (int i = 0; i < count; i += 4) {
        if (i % 8 == 0) fetch_ahead(body.read_by_gather, first + static_cast<std::uint32_t>(batch + i));
        for (int k = 0; k < 4 && i + k < count; ++k)
          sum<wanted>(stencils, map.lattice(), i + k, NodesOfOneField{read.data}, sums);
        sums.template transpose<wanted.second, wanted.gradient, wanted.affine>(i);
      }
      update_particles(body, map.lattice(), first, count, what, sums, result);
      terms.template prepare<added.second>(body, first, count, to_add, axisymmetric);
      if constexpr (added.affine) prepare_affine(body, map.lattice(), stencils, first, count, terms);
      for (int i = 0; i < count; ++i) add<added>(stencils, terms, map.lattice(), i, NodesOfOneField{written.data});
    }
    written.add_to(neighbours, to.nodes[0]);
  }

  // `nodes`: NodesOfOneField or NodesBySide.
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
    const std::ptrdiff_t base = s.base[i];
    Vec4 value{};
    [[maybe_unused]] Vec4 second{}, lx{}, ly{}, lz{}, bx{}, by{}, bz{};
#pragma GCC unroll 4
    for (int c = 0; c < (Dim == 3 ? width : 1); ++c) {
      Vec4 plane{};
      [[maybe_unused]] Vec4 plane_second{}, plane_x{}, plane_y{}, moment_x{}, moment_y{};
#pragma GCC unroll 4
      for (int b = 0; b < width; ++b) {
        const std::ptrdiff_t of_row = base + 8 * (c * NodePatch::plane + b * NodePatch::row);
        const double wy = s.w[1][b][i];
        // The sum of f(a) times a vector of the nodes of the row, which begins `at` numbers after that of the node.
        const auto along = [&](const double* f, int at) {
          Vec4 total = f[0] * load4(nodes((c * width + b) * width, of_row) + at);
          for (int a = 1; a < width; ++a)
            total += f[a] * load4(nodes((c * width + b) * width + a, of_row + 8 * a) + at);
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
