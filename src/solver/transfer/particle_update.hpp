// SPDX-License-Identifier: MIT
/// The update of particles from values interpolated from the nodes; the same for every kernel.
#pragma once

#include "base/parallel.hpp"
#include "base/simd.hpp"
#include "solver/transfer/stencils.hpp"
#include "solver/transfer/transfer.hpp"

#include <cstddef>
#include <vector>

namespace tribo {

/// Sums over the stencil of each particle: first for four particles with all components of a particle together
/// (`whole`, `slope`, `moment`), then for a batch with one array per component.
template <int Dim>
struct GatherSums {
  alignas(64) double whole[4][8];
  alignas(64) double slope[Dim][4][4];
  alignas(64) double moment[Dim][4][4];

  alignas(64) double velocity[Dim][batch_lanes];         ///< S v
  alignas(64) double acceleration[Dim][batch_lanes];     ///< S a
  alignas(64) double L[Layout<Dim>::full][batch_lanes];  ///< velocity gradient
  alignas(64) double affine[Dim * Dim][batch_lanes];     ///< sum w v (x_i - x)^T

  /// Transposes the sums of the particles i ... i + 3 into the arrays by component.
  template <bool Second, bool Gradient, bool Affine>
  void transpose(int i) {
    const auto spread = [i](const double(*rows)[4], int stride, double* x, double* y, double* z) {
      const double* r = rows[0];
      Vec4 a = load4(r), b = load4(r + stride), c = load4(r + 2 * stride), d = load4(r + 3 * stride);
      transpose4(a, b, c, d);
      store4(x + i, b), store4(y + i, c);
      if (z) store4(z + i, d);
    };
    const auto* parts = reinterpret_cast<const double(*)[4]>(whole);
    spread(parts, 8, velocity[0], velocity[1], Dim == 3 ? velocity[Dim - 1] : nullptr);
    if constexpr (Second)
      spread(parts + 1, 8, acceleration[0], acceleration[1], Dim == 3 ? acceleration[Dim - 1] : nullptr);
    for (int d = 0; d < Dim; ++d) {
      if constexpr (Gradient) {
        if constexpr (Dim == 2)
          spread(slope[d], 4, L[d], L[2 + d], nullptr);
        else
          spread(slope[d], 4, L[d], L[3 + d], L[6 + d]);
      }
      if constexpr (Affine)
        spread(moment[d], 4, affine[d], affine[Dim + d], Dim == 3 ? affine[(Dim - 1) * Dim + d] : nullptr);
    }
  }
};

/// Updates the particles first ... first + count - 1 of a body (position, velocity, deformation, stress, temperature)
/// according to `what`.
template <int Dim>
void update_particles(Body<Dim>& body, const Lattice<Dim>& lattice, std::uint32_t first, int count, const Gather& what,
                      GatherSums<Dim>& sums, GatherResult& result);

/// Collects one result per thread; the maximum does not depend on the order of the threads. An object is kept from
/// gather to gather, so that a gather allocates memory only after the number of threads has grown.
class GatherCollector {
 public:
  /// Clears the results and provides one for each thread that a parallel loop may use. Call it outside of such a loop.
  void start() { results_.assign(static_cast<std::size_t>(threads()), Slot{}); }
  /// The result of the calling thread.
  GatherResult& mine() { return results_[static_cast<std::size_t>(thread_index())].result; }
  /// The largest displacement, and whether all results are valid.
  GatherResult total() const {
    GatherResult all;
    for (const auto& r : results_) {
      if (r.result.travel > all.travel) all.travel = r.result.travel;
      all.valid = all.valid && r.result.valid;
    }
    return all;
  }

 private:
  struct alignas(64) Slot {
    GatherResult result;
  };
  std::vector<Slot> results_;
};

}  // namespace tribo
