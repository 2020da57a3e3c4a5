// SPDX-License-Identifier: MIT
/// XPIC and FMPM: velocity filters that approximate the consistent mass matrix more closely than the lumped one.
///
///   v(k) = sum over j < k of (1 - S+ S)^j v
///
/// S interpolates from nodes to particles, S+ scatters from particles to nodes and divides by the nodal mass. FMPM
/// filters the velocities after the momentum update, XPIC those before it; strains use the filtered velocities.
/// Hammerquist & Nairn,
/// CMAME 318 (2017) 724-753; Nairn & Hammerquist, CMAME 377 (2021) 113686.
#pragma once

#include "base/stopwatch.hpp"
#include "solver/boundary/nodal_conditions.hpp"
#include "solver/contact/contact.hpp"
#include "solver/state/system_loops.hpp"
#include "solver/transfer/system_transfers.hpp"

namespace tribo {

/// Filters the nodal velocities of all fields of deformable bodies.
template <int Dim>
class VelocityFilter {
 public:
  VelocityFilter(const Model& model, System<Dim>& system, const SystemLoops<Dim>& loops,
                 SystemTransfers<Dim>& transfers, const Exchanges<Dim>& exchanges,
                 std::vector<NodalConditions<Dim>>& conditions, Contact<Dim>& contact)
      : scheme_(model.scheme),
        system_(system),
        loops_(loops),
        transfers_(transfers),
        exchanges_(exchanges),
        conditions_(conditions),
        contact_(contact) {}

  /// Determines whether the filter acts in the current step. To be called at the start of a step.
  void begin_step();
  /// Whether the filter acts in this step.
  bool active() const { return active_; }
  /// Allocates the nodal layers of the filter. To be called after every change of the block maps of the fields.
  void locate();
  /// Computes v(k) of the nodal velocities and stores it in the velocities of the layer `filter`. `from_start`: use the
  /// shape functions at the positions at the start of the step.
  void filter(bool from_start);
  /// After the momentum update, replaces the nodal velocities by the filtered ones. XPIC filters the velocities without
  /// dt times the acceleration.
  void filter_update(double dt);

  /// Time of the next filtered step if the filter acts by period.
  double next = 0.0;
  /// Time spent in the filter.
  Stopwatch watch;

  /// Saves and restores the time of the next filtered step.
  friend void archive(Archive& a, VelocityFilter& filter) {
    auto& [its_next, its_watch, scheme, system, loops, transfers, exchanges, conditions, contact, active] = filter;
    a.version(1);
    a("next", its_next);
  }

 private:
  template <class F>
  void each_field(F&& f);
  template <class F>
  void each_node(F&& f);
  void sum_terms(double dt, bool from_start);
  void scatter_increments(bool from_start);

  const Scheme& scheme_;
  System<Dim>& system_;
  const SystemLoops<Dim>& loops_;
  SystemTransfers<Dim>& transfers_;
  const Exchanges<Dim>& exchanges_;
  std::vector<NodalConditions<Dim>>& conditions_;
  Contact<Dim>& contact_;
  bool active_ = false;
};

}  // namespace tribo
