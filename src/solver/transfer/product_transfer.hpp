// SPDX-License-Identifier: MIT
/// Transfers for kernels that are products of one-dimensional shape functions.
///
///   scatter   m_I = sum_p w_Ip m_p,   (m v)_I = sum_p w_Ip m_p (v_p + C_p (x_I - x_p)),
///             f_I = sum_p w_Ip f_p - V_p sigma_p grad w_Ip
///   gather    S v = sum_I w_Ip v_I,   L_p = sum_I v_I (x) grad w_Ip
///
/// A bin uses a small dense patch of nodes with constant strides. Shape functions and particle updates are computed
/// for batches in loops that the compiler vectorises.
#pragma once

#include "base/parallel.hpp"
#include "solver/transfer/product_sums.hpp"
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
               const BlockFlags<Dim>* only) const override {
    with_added_sums(what, static_cast<bool>(body.affine), [&](auto sums) {
      for (std::size_t c = 0; c < body.bins.colours().size(); ++c) {
        const auto& colour = body.bins.colours()[c];
        const auto before = [&](std::ptrdiff_t k) { return body.bins.before(c, static_cast<std::size_t>(k)); };
        parallel_for_weighted(static_cast<std::ptrdiff_t>(colour.size()), before, [&](std::ptrdiff_t k) {
          const Bin& bin = body.bins.with_ghosts()[colour[static_cast<std::size_t>(k)]];
          if (only && !(*only)[target.map[0]->lattice().block_at(bin.block)]) return;
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
    const auto bins = body.bins.list();
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
          const Bin& bin = body.bins.with_ghosts()[colour[static_cast<std::size_t>(k)]];
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
  using Sums = ProductSums<Dim, Kernel>;

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
      if constexpr (sums.affine && !sums.flux) Sums::prepare_affine(body, map.lattice(), stencils, first, count, terms);
      for (int i = 0; i < count; ++i) {
        if (i % 8 == 0) fetch_ahead(body.read_by_scatter, first + static_cast<std::uint32_t>(batch + i));
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        if (sides)
          Sums::template add_by_side<sums>(stencils, terms, map.lattice(), i, NodesBySide{data, sides});
        else
          Sums::template add<sums>(stencils, terms, map.lattice(), i, NodesOfOneField{patch.data});
      }
    }
    patch.add_to(map.neighbours(bin.block), target.nodes[0]);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.add_to(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
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
            Sums::template sum_by_side<wanted>(stencils, map.lattice(), i + k, NodesBySide{data, sides}, sums);
          else
            Sums::template sum<wanted>(stencils, map.lattice(), i + k, NodesOfOneField{patch.data}, sums);
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
          Sums::template sum<wanted>(stencils, map.lattice(), i + k, NodesOfOneField{read.data}, sums);
        sums.template transpose<wanted.second, wanted.gradient, wanted.affine>(i);
      }
      update_particles(body, map.lattice(), first, count, what, sums, result);
      terms.template prepare<added.second>(body, first, count, to_add, axisymmetric);
      if constexpr (added.affine) Sums::prepare_affine(body, map.lattice(), stencils, first, count, terms);
      for (int i = 0; i < count; ++i)
        Sums::template add<added>(stencils, terms, map.lattice(), i, NodesOfOneField{written.data});
    }
    written.add_to(neighbours, to.nodes[0]);
  }
};

}  // namespace tribo
