// SPDX-License-Identifier: MIT
/// Transfers with linear CPDI: linear shape functions averaged over the deformed particle domain, a parallelogram or
/// parallelepiped.
///
///   w_I = 2^-Dim sum_corners N_I(x_c),     grad w_I = R^-T 2^-Dim sum_corners s_c N_I(x_c)
///
/// The sums go over the corners and the nodes around each of them, so that no function of a node is formed.
///
/// R = [r_1 .. r_Dim] are the half edges of the domain, s_c = (+-1, ..) the natural coordinates of corner c.
/// Sadeghirad, Brannon & Burghardt, Int. J.
/// Numer. Meth. Engng 86 (2011) 1435-1456. Domains that reach beyond the limit are scaled: Homel, Brannon & Guilkey,
/// Int. J. Numer. Meth. Engng 107 (2016) 2, so that the stencil stays four nodes wide.
#pragma once

#include "solver/transfer/cpdi_domains.hpp"
#include "solver/transfer/cut_patches.hpp"
#include "solver/transfer/particle_update.hpp"
#include "solver/transfer/scatter_terms.hpp"
#include "solver/transfer/transfer_sums.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
class CpdiTransfers final : public Transfers<Dim> {
 public:
  static constexpr int width = CpdiDomains<Dim>::width;
  static constexpr int corners = CpdiDomains<Dim>::corners;
  using NodePatch = Patch<Dim, width>;

  /// `limit`: largest distance of a corner from the centre along an axis [cells]; values above 1 act as 1.
  explicit CpdiTransfers(double limit) : limit_(std::min(limit, 1.0)) {}

  double shift() const override { return 1.0; }
  int colours_per_axis() const override { return width + 1 <= block_edge<Dim> ? 2 : 3; }

  int stencil_width() const override { return width; }

  void lowest_nodes(Body<Dim>& body, const Lattice<Dim>& lattice, const Bin& bin,
                    std::vector<Index<Dim>>& lowest) const override {
    const auto block = lattice.block_at(bin.block);
    const auto x = body.particles.x();
    Domains domains;
    lowest.resize(bin.end - bin.begin);
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      domains.compute(body, lattice, block, x, first, count, limit_);
      for (int i = 0; i < count; ++i)
        lowest[first - bin.begin + static_cast<std::uint32_t>(i)] = NodePatch::node(block, domains.base[i]);
    }
  }

  void scatter(Body<Dim>& body, const Target<Dim>& target, Scatter what, bool from_start, bool axisymmetric,
               const BlockFlags<Dim>* only) const override {
    with_added_sums(what, static_cast<bool>(body.affine), [&](auto sums) {
      for (const auto& colour : body.bins.colours())
        parallel_for(static_cast<std::ptrdiff_t>(colour.size()), [&](std::ptrdiff_t k) {
          const Bin& bin = body.bins.with_ghosts()[colour[static_cast<std::size_t>(k)]];
          if (only && !(*only)[target.map[0]->lattice().block_at(bin.block)]) return;
          const CutBin* cut = body.cut_bin(colour[static_cast<std::size_t>(k)]);
          scatter_bin<sums()>(body, target, bin, cut, what, from_start, axisymmetric);
        });
    });
  }

  GatherResult gather(Body<Dim>& body, const Target<Dim>& target, const Gather& what) const override {
    thread_local GatherCollector of_thread;
    GatherCollector& collector = of_thread;  // of this one, in the loop below
    collector.start();
    const auto bins = body.bins.list();
    with_gathered_sums(what, static_cast<bool>(body.affine), [&](auto sums) {
      parallel_for(static_cast<std::ptrdiff_t>(bins.size()), [&](std::ptrdiff_t k) {
        const auto bin = static_cast<std::size_t>(k);
        gather_bin<sums()>(body, target, bins[bin], body.cut_bin(bin), what, collector.mine());
      });
    });
    return collector.total();
  }

 private:
  using Across = CutPatches<Dim, width>;
  using Domains = CpdiDomains<Dim>;

  // m C with C = B D^-1.
  static void prepare_affine(Body<Dim>& body, const Lattice<Dim>& lattice, const Domains& domains, std::uint32_t first,
                             int count, ScatterTerms<Dim>& terms) {
    const auto columns = body.particles[body.affine];
    for (int i = 0; i < count; ++i) {
      const std::size_t p = first + static_cast<std::size_t>(i);
      Mat<Dim> B;
      for (int k = 0; k < Dim * Dim; ++k) B(k / Dim, k % Dim) = columns[static_cast<std::size_t>(k)][p];
      const Mat<Dim> C = body.particles.mass()[p] * B * domains.second_moments(lattice, i).inverse();
      for (int d = 0; d < Dim; ++d) {
        store4(terms.affine[d][i], Vec4{});
        Eigen::Map<Vec<Dim>>(terms.affine[d][i] + 1) = C.col(d);
      }
    }
  }

  template <AddedSums sums>
  void scatter_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, Scatter what,
                   bool from_start, bool axisymmetric) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto& lattice = map.lattice();
    const auto block = lattice.block_at(bin.block);
    const auto x = from_start ? body.particles[body.start] : body.particles.x();
    NodePatch patch;
    patch.clear();
    Across across(cut, target);
    const auto data = across.data(patch);
    Domains domains;
    ScatterTerms<Dim> terms;
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      terms.template prepare<sums.second>(body, first, count, what, axisymmetric);
      domains.compute(body, lattice, block, x, first, count, limit_);
      if constexpr (sums.affine && !sums.flux) prepare_affine(body, lattice, domains, first, count, terms);
      for (int i = 0; i < count; ++i) {
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        add<sums>(domains, terms, lattice, i, sides, data);
      }
    }
    patch.add_to(map.neighbours(bin.block), target.nodes[0]);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.add_to(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
  }

  // Each corner carries its share of the values of the particle, and the fluxes times the gradients of the natural
  // coordinates with the signs of the corner.
  template <AddedSums sums>
  static void add(const Domains& domains, const ScatterTerms<Dim>& terms, const Lattice<Dim>& lattice, int i,
                  const std::uint8_t* sides, const std::array<double*, 4>& data) {
    constexpr double share = 1.0 / corners;
    const Vec4 first = share * load4(terms.whole[i]), second = share * load4(terms.whole[i] + 4);
    [[maybe_unused]] Vec4 flux[Dim] = {}, affine[Dim] = {};
    for (int d = 0; d < Dim; ++d) {
      if constexpr (sums.second || sums.flux)
        for (int k = 0; k < Dim; ++k) flux[k] += domains.slope[k][d][i] * load4(terms.flux[d][i]);
      if constexpr (sums.affine) affine[d] = share * load4(terms.affine[d][i]);
    }
    for (int c = 0; c < corners; ++c) {
      [[maybe_unused]] Vec4 at_corner = sums.flux ? first : second;
      if constexpr (sums.second || sums.flux)
        for (int k = 0; k < Dim; ++k) at_corner += Domains::sign(c, k) * flux[k];
      domains.each_node(lattice, i, c, [&](int offset, int index, double hat, [[maybe_unused]] const auto& distance) {
        double* node = data[sides ? sides[index] : 0] + offset;
        if constexpr (sums.first) {
          Vec4 value = sums.flux ? at_corner : first;
          if constexpr (sums.affine)
            for (std::size_t d = 0; d < Dim; ++d) value += distance[d] * affine[d];
          store4(node, load4(node) + hat * value);
        }
        if constexpr (sums.second) store4(node + 4, load4(node + 4) + hat * at_corner);
      });
    }
  }

  template <GatheredSums wanted>
  void gather_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, const Gather& what,
                  GatherResult& result) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto& lattice = map.lattice();
    const auto block = lattice.block_at(bin.block);
    const auto x = what.from_start ? body.particles[body.start] : body.particles.x();
    NodePatch patch;
    patch.load(map.neighbours(bin.block), target.nodes[0]);
    Across across(cut, target);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.load(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
    const auto data = across.data(patch);
    Domains domains;
    GatherSums<Dim> sums;
    if constexpr (!wanted.second) std::fill_n(sums.acceleration[0], Dim * batch_lanes, 0.0);
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      domains.compute(body, lattice, block, x, first, count, limit_);
      for (int i = 0; i < count; ++i) {
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        sum<wanted>(domains, lattice, i, sides, data, sums);
        if (i % 4 == 3 || i == count - 1)
          sums.template transpose<wanted.second, wanted.gradient, wanted.affine>(i / 4 * 4);
      }
      update_particles(body, lattice, first, count, what, sums, result);
    }
  }

  template <GatheredSums wanted>
  static void sum(const Domains& domains, const Lattice<Dim>& lattice, int i, const std::uint8_t* sides,
                  const std::array<double*, 4>& data, GatherSums<Dim>& sums) {
    constexpr double share = 1.0 / corners;
    Vec4 value{}, second{};
    [[maybe_unused]] Vec4 natural[Dim] = {}, moment[Dim] = {};
    for (int c = 0; c < corners; ++c) {
      Vec4 at_corner{};
      domains.each_node(lattice, i, c, [&](int offset, int index, double hat, [[maybe_unused]] const auto& distance) {
        const double* node = data[sides ? sides[index] : 0] + offset;
        const Vec4 part = hat * load4(node);
        at_corner += part;
        if constexpr (wanted.second) second += hat * load4(node + 4);
        if constexpr (wanted.affine)
          for (std::size_t d = 0; d < Dim; ++d) moment[d] += distance[d] * part;
      });
      value += at_corner;
      if constexpr (wanted.gradient)
        for (int k = 0; k < Dim; ++k) natural[k] += Domains::sign(c, k) * at_corner;
    }
    store4(sums.whole[i % 4], share * value);
    if constexpr (wanted.second) store4(sums.whole[i % 4] + 4, share * second);
    for (int d = 0; d < Dim; ++d) {
      if constexpr (wanted.gradient) {
        Vec4 slope{};
        for (int k = 0; k < Dim; ++k) slope += domains.slope[k][d][i] * natural[k];
        store4(sums.slope[d][i % 4], slope);
      }
      if constexpr (wanted.affine) store4(sums.moment[d][i % 4], share * moment[d]);
    }
  }

  double limit_;
};

}  // namespace tribo
