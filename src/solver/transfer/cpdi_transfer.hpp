// SPDX-License-Identifier: MIT
/// Transfers with linear CPDI: linear shape functions averaged over the deformed particle domain, a parallelogram or
/// parallelepiped.
///
///   w_I = 2^-Dim sum_corners N_I(x_c),     grad w_I = R^-T 2^-Dim sum_corners s_c N_I(x_c)
///
/// R = [r_1 .. r_Dim] are the half edges of the domain, s_c = (+-1, ..) the natural coordinates of corner c.
/// Sadeghirad, Brannon & Burghardt, Int. J.
/// Numer. Meth. Engng 86 (2011) 1435-1456. Domains that reach beyond the limit are scaled: Homel, Brannon & Guilkey,
/// Int. J. Numer. Meth. Engng 107 (2016) 2, so that the stencil stays four nodes wide.
#pragma once

#include "solver/transfer/cut_patches.hpp"
#include "solver/transfer/particle_update.hpp"
#include "solver/transfer/scatter_terms.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
class CpdiTransfers final : public Transfers<Dim> {
 public:
  static constexpr int width = 4;
  static constexpr int nodes_per_particle = Dim == 2 ? 16 : 64;
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
    lowest.clear();
    for (std::size_t i = bin.begin; i < bin.end; ++i)
      lowest.push_back(NodePatch::node(block, stencil(body, lattice, block, x, i).base));
  }

  void scatter(Body<Dim>& body, const Target<Dim>& target, Scatter what, bool from_start, bool axisymmetric,
               const std::vector<char>* only) const override {
    const bool force = uses_gradients(what);
    for (const auto& colour : body.bins.colours())
      parallel_for(static_cast<std::ptrdiff_t>(colour.size()), [&](std::ptrdiff_t k) {
        const Bin& bin = body.bins.list()[colour[static_cast<std::size_t>(k)]];
        if (only && !(*only)[static_cast<std::size_t>(bin.block)]) return;
        const CutBin* cut = body.cut_bin(colour[static_cast<std::size_t>(k)]);
        force ? scatter_bin<true>(body, target, bin, cut, what, from_start, axisymmetric)
              : scatter_bin<false>(body, target, bin, cut, what, from_start, axisymmetric);
      });
  }

  GatherResult gather(Body<Dim>& body, const Target<Dim>& target, const Gather& what) const override {
    thread_local GatherCollector of_thread;
    GatherCollector& collector = of_thread;  // of this one, in the loop below
    collector.start();
    const auto& bins = body.bins.list();
    parallel_for(static_cast<std::ptrdiff_t>(bins.size()), [&](std::ptrdiff_t k) {
      const auto bin = static_cast<std::size_t>(k);
      gather_bin(body, target, bins[bin], body.cut_bin(bin), what, collector.mine());
    });
    return collector.total();
  }

 private:
  using Across = CutPatches<Dim, width>;

  struct Stencil {
    int base;                           ///< offset of the lowest node in the patch, in doubles
    double w[nodes_per_particle];       ///< shape functions of the nodes, x fastest
    double g[Dim][nodes_per_particle];  ///< gradients of the shape functions [1/length]
    Vec<Dim> to_base;                   ///< lowest node minus particle [length]
  };

  static constexpr int offset(int n) { return 8 * (n % 4 + n / 4 % 4 * NodePatch::row + n / 16 * NodePatch::plane); }
  static Vec<Dim> distance(const Stencil& s, const Lattice<Dim>& lattice, int n) {
    Vec<Dim> d = s.to_base;
    const int i = n % 4, j = n / 4 % 4, k = n / 16;
    d[0] += i * lattice.spacing[0], d[1] += j * lattice.spacing[1];
    if constexpr (Dim == 3) d[2] += k * lattice.spacing[2];
    static_cast<void>(k);
    return d;
  }

  Stencil stencil(Body<Dim>& body, const Lattice<Dim>& lattice, const Index<Dim>& block,
                  const typename Particles<Dim>::Vector& x, std::size_t i) const {
    // Half edges of the domain in cells
    Mat<Dim> R;
    if (body.half_axes) {
      Mat<Dim> initial, F;
      for (int c = 0; c < Dim * Dim; ++c) {
        const auto k = static_cast<std::size_t>(c);
        initial(c / Dim, c % Dim) = body.particles[body.half_axes][k][i];
        F(c / Dim, c % Dim) = body.particles[body.domain][k][i];
      }
      R = lattice.spacing.cwiseInverse().asDiagonal() * (F * initial);
    }
    for (int c = 0; c < Dim && !body.half_axes; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const double half = body.half_size ? body.particles[body.half_size][k][i] : body.uniform_half_size[c];
      for (int r = 0; r < Dim; ++r)
        R(r, c) = half * body.particles[body.domain][static_cast<std::size_t>(r * Dim + c)][i] / lattice.spacing[r];
    }
    const double reach = R.cwiseAbs().rowwise().sum().maxCoeff();
    if (reach > limit_) R *= limit_ / reach;

    Stencil s{};
    Vec<Dim> at;
    Index<Dim> base;
    s.base = 0;
    constexpr int stride[3] = {8, 8 * NodePatch::row, 8 * NodePatch::plane};
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const double inverse = 1.0 / lattice.spacing[d];
      const double cells = x[k][i] * inverse - (lattice.origin[d] * inverse + (block[k] * block_edge<Dim> - 1));
      base[k] = static_cast<int>(cells - 1.0);
      at[d] = cells - base[k];
      s.base += base[k] * stride[d];
      s.to_base[d] = -at[d] * lattice.spacing[d];
    }
    constexpr int corners = 1 << Dim;
    double natural[Dim][nodes_per_particle] = {};
    for (int c = 0; c < corners; ++c) {
      Vec<Dim> sign;
      for (int d = 0; d < Dim; ++d) sign[d] = c >> d & 1 ? 1.0 : -1.0;
      const Vec<Dim> corner = at + R * sign;
      int node[Dim];
      double part[Dim];
      for (int d = 0; d < Dim; ++d)
        node[d] = std::clamp(static_cast<int>(corner[d]), 0, 2), part[d] = corner[d] - node[d];
      for (int n = 0; n < corners; ++n) {
        double N = 1.0 / corners;
        int index = 0;
        for (int d = 0; d < Dim; ++d) {
          const int up = n >> d & 1;
          N *= up ? part[d] : 1 - part[d];
          index += (node[d] + up) << (2 * d);
        }
        s.w[index] += N;
        for (int d = 0; d < Dim; ++d) natural[d][index] += sign[d] * N;
      }
    }
    const Mat<Dim> T = R.inverse();
    for (int d = 0; d < Dim; ++d)
      for (int n = 0; n < nodes_per_particle; ++n) {
        double sum = 0.0;
        for (int k = 0; k < Dim; ++k) sum += T(k, d) * natural[k][n];
        s.g[d][n] = sum / lattice.spacing[d];
      }
    return s;
  }

  // m C with C = B D^-1, D = sum w (x_I - x)(x_I - x)^T.
  static Mat<Dim> affine_momentum(Body<Dim>& body, const Stencil& s, const Lattice<Dim>& lattice, std::size_t i) {
    Mat<Dim> B, D = Mat<Dim>::Zero();
    for (std::size_t k = 0; k < Dim * Dim; ++k)
      B(static_cast<int>(k) / Dim, static_cast<int>(k) % Dim) = body.particles[body.affine][k][i];
    for (int n = 0; n < nodes_per_particle; ++n) {
      const Vec<Dim> r = distance(s, lattice, n);
      D += s.w[n] * r * r.transpose();
    }
    return body.particles.mass()[i] * B * D.inverse();
  }

  template <bool Force>
  void scatter_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, Scatter what,
                   bool from_start, bool axisymmetric) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto& lattice = map.lattice();
    const auto block = lattice.block_at(bin.block);
    const auto x = from_start ? body.particles[body.start] : body.particles.x();
    const bool affine = body.affine && (what == Scatter::momentum || what == Scatter::momentum_and_force);
    NodePatch patch;
    patch.clear();
    Across across(cut != nullptr);
    ScatterTerms<Dim> terms;
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      terms.template prepare<Force>(body, first, count, what, axisymmetric);
      for (int i = 0; i < count; ++i) {
        const Stencil s = stencil(body, lattice, block, x, first + static_cast<std::size_t>(i));
        const Mat<Dim> C =
            affine ? affine_momentum(body, s, lattice, first + static_cast<std::size_t>(i)) : Mat<Dim>::Zero();
        const Wide whole = Wide::load(terms.whole[i]);
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        const auto data = across.data(patch);
        for (int n = 0; n < nodes_per_particle; ++n) {
          double* node = data[sides ? sides[n] : 0] + s.base + offset(n);
          Wide sum = Wide::load(node) + s.w[n] * whole;
          if constexpr (Force)
            for (int d = 0; d < Dim; ++d) sum = sum + s.g[d][n] * Upper::from(load4(terms.flux[d][i]));
          sum.store(node);
          if (affine) Eigen::Map<Vec<Dim>>(node + 1) += s.w[n] * (C * distance(s, lattice, n));
          if (what == Scatter::heat) {
            const Vec<Dim> r = distance(s, lattice, n);
            for (int d = 0; d < Dim; ++d) node[1] += s.w[n] * r[d] * terms.affine[d][i][1];
          }
        }
      }
    }
    patch.add_to(map.neighbours(bin.block), target.nodes[0]);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.add_to(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
  }

  void gather_bin(Body<Dim>& body, const Target<Dim>& target, const Bin& bin, const CutBin* cut, const Gather& what,
                  GatherResult& result) const {
    const BlockMap<Dim>& map = *target.map[0];
    const auto& lattice = map.lattice();
    const auto block = lattice.block_at(bin.block);
    const auto x = what.from_start ? body.particles[body.start] : body.particles.x();
    NodePatch patch;
    patch.load(map.neighbours(bin.block), target.nodes[0]);
    Across across(cut != nullptr);
    across.each(target, [&](std::size_t k, NodePatch& beyond) {
      beyond.load(target.map[k]->neighbours(bin.block), target.nodes[k]);
    });
    GatherSums<Dim> sums;
    for (std::uint32_t first = bin.begin; first < bin.end; first += batch) {
      const int count = static_cast<int>(std::min<std::uint32_t>(batch, bin.end - first));
      for (int i = 0; i < count; ++i) {
        const Stencil s = stencil(body, lattice, block, x, first + static_cast<std::size_t>(i));
        Wide value = Wide::zero();
        Vec4 slope[Dim] = {}, moment[Dim] = {};
        const std::uint8_t* sides = cut ? cut->of(first - bin.begin + static_cast<std::uint32_t>(i)) : nullptr;
        const auto data = across.data(patch);
        for (int n = 0; n < nodes_per_particle; ++n) {
          const Wide node = Wide::load(data[sides ? sides[n] : 0] + s.base + offset(n));
          value = value + s.w[n] * node;
          for (int d = 0; d < Dim; ++d) slope[d] += s.g[d][n] * node.low();
          if (body.affine) {
            const Vec<Dim> r = distance(s, lattice, n);
            for (int d = 0; d < Dim; ++d) moment[d] += s.w[n] * r[d] * node.low();
          }
        }
        value.store(sums.whole[i % 4]);
        for (int d = 0; d < Dim; ++d) store4(sums.slope[d][i % 4], slope[d]), store4(sums.moment[d][i % 4], moment[d]);
        if (i % 4 == 3 || i == count - 1) sums.template transpose<true, true, true>(i / 4 * 4);
      }
      update_particles(body, lattice, first, count, what, sums, result);
    }
  }

  double limit_;
};

}  // namespace tribo
