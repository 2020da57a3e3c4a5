// SPDX-License-Identifier: MIT
/// The work of all forces at the nodes: the part of the energy balance from which the transfers follow.
#pragma once

#include "solver/exchange/exchange.hpp"

#include <vector>

namespace tribo {

/// Adds up m a . (v - a dt/2) dt over the nodes of deformable bodies, the work of internal, external and contact forces
/// together. Without constraints it is the change of the kinetic energy of the nodes; the difference to that of the
/// particles is the dissipation of the transfers (EnergyLedger::transfer_loss). Velocities and accelerations are those
/// that move the particles, after contact, prescribed velocities and filters.
template <int Dim>
class NodalWork {
 public:
  NodalWork(System<Dim>& system, const Exchanges<Dim>& exchanges, EnergyLedger& ledger)
      : system_(system), exchanges_(exchanges), ledger_(ledger) {}

  /// Adds the work of a step of size `dt` to the ledger.
  void record(double dt);

 private:
  System<Dim>& system_;
  const Exchanges<Dim>& exchanges_;
  EnergyLedger& ledger_;
  std::vector<double> by_block_;
};

}  // namespace tribo
