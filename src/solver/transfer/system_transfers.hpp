// SPDX-License-Identifier: MIT
/// Transfers between the particles of all deformable bodies and the nodes of their fields.
#pragma once

#include "solver/distribution/distribution.hpp"
#include "solver/state/system_loops.hpp"
#include "solver/transfer/scattered_columns.hpp"
#include "solver/transfer/transfer.hpp"

#include <utility>
#include <vector>

namespace tribo {

/// The transfers of a scheme, applied to all bodies together. Before a scatter the ghosts of other processes receive
/// the present values of their particles.
template <int Dim>
class SystemTransfers {
 public:
  SystemTransfers(System<Dim>& system, const SystemLoops<Dim>& loops, const Transfers<Dim>& transfers,
                  Distribution<Dim>& distribution)
      : system_(system), loops_(loops), transfers_(transfers), distribution_(distribution) {}

  /// Adds the sums `what` over the particles to a layer of nodes, see Transfers::scatter.
  template <class N>
  void scatter(AlignedVector<N> Field<Dim>::*layer, Scatter what, bool from_start, bool axisymmetric) {
    distribution_.refresh_ghosts(2 * static_cast<int>(what) + (from_start ? 1 : 0),
                                 [&](Body<Dim>& body) { return scattered_columns(body, what, from_start); });
    loops_.each_body([&](std::size_t k) {
      auto& body = system_.bodies[k];
      transfers_.scatter(body, Target<Dim>(body, system_.fields, layer), what, from_start, axisymmetric);
    });
  }
  /// Interpolates a layer of nodes to the particles. `what(body)` gives the options for a body. Returns the result of
  /// each body.
  template <class N, class Options>
  const std::vector<GatherResult>& gather(AlignedVector<N> Field<Dim>::*layer, Options&& what) {
    results_.resize(system_.bodies.size());
    loops_.each_body([&](std::size_t k) {
      auto& body = system_.bodies[k];
      results_[k] = transfers_.gather(body, Target<Dim>(body, system_.fields, layer), what(body));
    });
    return results_;
  }
  /// Both, one after the other, in one loop where no ghosts have to be updated in between.
  template <class N, class M, class Options>
  const std::vector<GatherResult>& gather_and_scatter(AlignedVector<N> Field<Dim>::*from, Options&& what,
                                                      AlignedVector<M> Field<Dim>::*to, Scatter sums,
                                                      bool axisymmetric) {
    if (distribution_.active()) {
      gather(from, what);
      const Gather any = what(system_.bodies.front());
      scatter(to, sums, any.move || any.from_start, axisymmetric);
      return results_;
    }
    results_.resize(system_.bodies.size());
    loops_.each_body([&](std::size_t k) {
      auto& body = system_.bodies[k];
      results_[k] = transfers_.gather_and_scatter(body, Target<Dim>(body, system_.fields, from), what(body),
                                                  Target<Dim>(body, system_.fields, to), sums, axisymmetric);
    });
    return results_;
  }

 private:
  System<Dim>& system_;
  const SystemLoops<Dim>& loops_;
  const Transfers<Dim>& transfers_;
  Distribution<Dim>& distribution_;
  std::vector<GatherResult> results_;  // per body, of the last gathering
};

}  // namespace tribo
