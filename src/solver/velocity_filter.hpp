// SPDX-License-Identifier: MIT
/// XPIC and FMPM: velocities sharper than those of the lumped mass matrix.
///
///   v(k) = sum over j < k of (1 - S+ S)^j v
///
/// S gathers from nodes to particles, S+ scatters back and divides by the nodal mass. FMPM filters the velocities after
/// the momentum update, XPIC those before the forces; strains follow the filtered velocities. Hammerquist & Nairn,
/// CMAME 318 (2017) 724-753; Nairn & Hammerquist, CMAME 377 (2021) 113686.
#pragma once

#include "base/stopwatch.hpp"
#include "solver/boundary/nodal_conditions.hpp"
#include "solver/contact/contact.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

template <int Dim>
class VelocityFilter {
 public:
  VelocityFilter(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers,
                 const Exchanges<Dim>& exchanges, const std::vector<NodalConditions<Dim>>& conditions,
                 Contact<Dim>& contact)
      : scheme_(model.scheme),
        system_(system),
        transfers_(transfers),
        exchanges_(exchanges),
        conditions_(conditions),
        contact_(contact) {}

  /// Decides whether the filter acts in the step that begins.
  void begin_step();
  /// True if it does.
  bool active() const { return active_; }
  /// Makes room on the present nodes; to be called after every change of the fields' maps.
  void locate();
  /// Leaves v(k) in the velocities of the layer `filter`. dt > 0: after the momentum update, from which XPIC first
  /// takes the forces out. `from_start`: with the weights of the step's start.
  void filter(double dt, bool from_start);
  /// Gives the filtered velocities to the nodes.
  void use(double dt);

  /// Time of the next filtered step if the filter acts by period.
  double next = 0.0;
  Stopwatch watch;

  /// Whether the filter acts is decided in every step.
  friend void archive(Archive& a, VelocityFilter& filter) {
    auto& [next, watch, scheme, system, transfers, exchanges, conditions, contact, active] = filter;
    a.version(1);
    a("next", next);
  }

 private:
  template <class F>
  void each_field(F&& f);

  const Scheme& scheme_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  const Exchanges<Dim>& exchanges_;
  const std::vector<NodalConditions<Dim>>& conditions_;
  Contact<Dim>& contact_;
  bool active_ = false;
};

}  // namespace tribo
