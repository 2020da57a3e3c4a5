// SPDX-License-Identifier: MIT
/// The terms of a batch of particles in the sums at the nodes, arranged for vector operations; the same for every
/// kernel.
#pragma once

#include "base/simd.hpp"
#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

/// Prefetches eight particles of a later batch, since a bin reads more columns than the hardware prefetcher follows.
/// The calls are distributed over the sums of the current batch, so that the loads do not queue up.
inline void fetch_ahead(const std::vector<const double*>& columns, std::uint32_t later) {
  for (const double* column : columns) __builtin_prefetch(column + later);
}

/// Per particle: the vectors that multiply the shape function and its gradient.
template <int Dim>
struct ScatterTerms {
  alignas(64) double whole[batch_lanes][8];        ///< times w: (m, m v | 0, f)
  alignas(64) double flux[Dim][batch_lanes][4];    ///< times dw/dx_d: -V sigma e_d; of heat -V k dT/dx_d
  alignas(64) double affine[Dim][batch_lanes][4];  ///< times w (x_I - x)_d: m C e_d; of heat m c dT/dx_d

  /// Computes `whole`, and `flux` if forces are scattered, for the particles first ... first + count - 1.
  template <bool Force>
  void prepare(Body<Dim>& body, std::uint32_t first, int count, Scatter what, bool axisymmetric) {
    if (what == Scatter::volume) {
      prepare_volume(body, first, count, axisymmetric);
      return;
    }
    if (what == Scatter::heat) {
      prepare_heat(body, first, count);
      return;
    }
    if (what == Scatter::heat_residual) {
      prepare_residual(body, first, count);
      return;
    }
    if (what == Scatter::volumetric) {
      prepare_volumetric(body, first, count);
      return;
    }
    const double* m = body.particles.mass() + first;
    const auto v = what == Scatter::filtered ? body.particles[body.filtered] : body.particles.v();
    const bool momentum = what != Scatter::force;
    for (int i = 0; i < count; i += 4) {
      const Vec4 mass = momentum ? load4(m + i) : Vec4{};
      Vec4 a = mass, b = mass * load4(v[0] + first + i), c = mass * load4(v[1] + first + i), d{};
      if constexpr (Dim == 3) d = mass * load4(v[2] + first + i);
      transpose4(a, b, c, d);
      store4(whole[i], a), store4(whole[i + 1], b), store4(whole[i + 2], c), store4(whole[i + 3], d);
      for (int k = 0; k < 4; ++k) store4(whole[i + k] + 4, Vec4{});
    }
    if constexpr (Force) prepare_force(body, first, count, axisymmetric);
  }

  /// Stores vectors with the components x, y and z of the particles i ... i + 3 after a zero.
  static void spread(double (*to)[4], int i, Vec4 x, Vec4 y, Vec4 z) {
    Vec4 none{};
    transpose4(none, x, y, z);
    store4(to[i], none), store4(to[i + 1], x), store4(to[i + 2], y), store4(to[i + 3], z);
  }

 private:
  // A unit stress in place of the stress makes the nodal force the gradient of the nodal volume.
  void prepare_volume(Body<Dim>& body, std::uint32_t first, int count, bool axisymmetric) {
    const double* volume = body.particles.volume() + first;
    const auto x = body.particles.x();
    const auto origin = body.particles[body.origin];
    for (int i = 0; i < count; ++i) {
      const double v = volume[i];
      const auto p = first + static_cast<std::uint32_t>(i);
      for (double& w : whole[i]) w = 0.0;
      whole[i][0] = v;
      for (std::size_t d = 0; d < Dim; ++d) {
        whole[i][1 + d] = v * (body.volume_of_displacement ? x[d][p] - origin[d][p] : x[d][p]);
        for (double& w : flux[d][i]) w = 0.0;
        flux[d][i][1 + d] = v;
      }
      if (axisymmetric) whole[i][5] = v / x[0][p];
    }
  }

  // All sums of heat go to the first vector of a node: the capacity, the heat and the power. The particle temperature
  // is extrapolated to the nodes with its gradient, so that linear temperature fields are exact at surfaces and
  // contacts as well.
  void prepare_heat(Body<Dim>& body, std::uint32_t first, int count) {
    const double* m = body.particles.mass() + first;
    const double* volume = body.particles.volume() + first;
    const double* temperature = body.particles[body.temperature] + first;
    const auto gradient = body.particles[body.temperature_gradient];
    for (int i = 0; i < count; i += 4) {
      const Vec4 conduction = -body.conductivity * load4(volume + i);
      const Vec4 capacity = body.heat_capacity * load4(m + i);
      Vec4 a = capacity, b = capacity * load4(temperature + i), c{}, d{};
      transpose4(a, b, c, d);
      store4(whole[i], a), store4(whole[i + 1], b), store4(whole[i + 2], c), store4(whole[i + 3], d);
      for (std::size_t k = 0; k < Dim; ++k) {
        const Vec4 slope = load4(gradient[k] + first + i);
        spread(affine[k], i, capacity * slope, Vec4{}, Vec4{});
        spread(flux[k], i, Vec4{}, conduction * slope, Vec4{});
      }
    }
  }

  void prepare_residual(Body<Dim>& body, std::uint32_t first, int count) {
    const double* m = body.particles.mass() + first;
    const double* residual = body.particles[body.temperature_residual] + first;
    for (int i = 0; i < count; ++i) {
      const double capacity = m[i] * body.heat_capacity;
      for (double& w : whole[i]) w = 0.0;
      whole[i][0] = capacity, whole[i][1] = capacity * body.residual_share * residual[i];
    }
  }

  void prepare_volumetric(Body<Dim>& body, std::uint32_t first, int count) {
    const double* volume = body.particles.volume() + first;
    const double* part = body.particles[body.volumetric] + first;
    for (int i = 0; i < count; ++i) {
      for (double& w : whole[i]) w = 0.0;
      whole[i][0] = volume[i], whole[i][1] = volume[i] * part[i];
    }
  }

  void prepare_force(Body<Dim>& body, std::uint32_t first, int count, bool axisymmetric) {
    const auto s = body.particles.stress();
    const double* volume = body.particles.volume() + first;
    const double* mean = body.volumetric ? body.particles[body.volumetric] + first : nullptr;
    for (int i = 0; i < count; i += 4) {
      const Vec4 k = -load4(volume + i);
      const Vec4 more = mean ? k * load4(mean + i) : Vec4{};
      const auto stress = [&](std::size_t c) { return k * load4(s[c] + first + i); };
      const Vec4 xy = stress(3);
      if constexpr (Dim == 2) {
        spread(flux[0], i, stress(0) + more, xy, Vec4{});
        spread(flux[1], i, xy, stress(1) + more, Vec4{});
      } else {
        const Vec4 yz = stress(4), xz = stress(5);
        spread(flux[0], i, stress(0) + more, xy, xz);
        spread(flux[1], i, xy, stress(1) + more, yz);
        spread(flux[2], i, xz, yz, stress(2) + more);
      }
    }
    if (body.load) {
      const auto f = body.particles[body.load];
      for (int i = 0; i < count; ++i)
        for (std::size_t d = 0; d < Dim; ++d) whole[i][5 + d] += f[d][first + static_cast<std::uint32_t>(i)];
    }
    if (axisymmetric) {  // radial component of the hoop stress
      const double* r = body.particles.x()[0] + first;
      for (int i = 0; i < count; ++i)
        whole[i][5] -= volume[i] * (s[2][first + static_cast<std::uint32_t>(i)] + (mean ? mean[i] : 0.0)) / r[i];
    }
  }
};

}  // namespace tribo
