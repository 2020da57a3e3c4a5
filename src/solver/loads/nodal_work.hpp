// SPDX-License-Identifier: MIT
/// The work of all forces at the nodes: the part of the energy balance from which the transfers follow.
#pragma once

#include "solver/exchange/exchange.hpp"

#include <vector>

namespace tribo {

/// Adds up m a . (v_0 + v_1)/2 dt over the nodes of deformable bodies, the work of internal, external and contact
/// forces together; the difference to the change of the kinetic energy of the particles is the dissipation of the
/// transfers (EnergyLedger::transfer_loss). v_0 are the velocities at the start of the step, v_1 those that strain the
/// particles at its end: the velocities of the momentum update, after contact, prescribed velocities and filters, or in
/// the "+" variants those that are extrapolated again. With the velocities of the momentum update, nodes of these
/// variants would do work that no strain takes up.
///
/// USAVG strains the particles in two halves, at the start and the end of the step. There v_0 are the velocities that
/// strain them at the start, after contact, prescribed velocities and filters.
///
/// FMPM (`filtered`) moves and strains the particles with filtered velocities v*, while a is the acceleration of lumped
/// masses, which can be large at light nodes and in contact where v* does not change. The mean is then v* - a* dt/2,
/// where a* is the change of the velocities of the particles over dt, transferred to the nodes: m a . a* is the sum of
/// m_p (S a) . a_p over the particles. USAVG needs no such estimate, since v_0 is known.
template <int Dim>
class NodalWork {
 public:
  NodalWork(System<Dim>& system, const Exchanges<Dim>& exchanges, EnergyLedger& ledger)
      : system_(system), exchanges_(exchanges), ledger_(ledger) {}

  /// For USAVG, before the strains at the start of a step: keeps the velocities of the nodes, or of the filter if the
  /// particles are strained with those (Field::start_velocities). The records of the step then take them for v_0.
  void keep_start(bool strain_filtered);
  /// Adds the work of a step of size `dt` to the ledger, if the particles are strained with the present velocities.
  void record(double dt, bool filtered);
  /// The same for the "+" variants: adds the work at the velocities at the start of the step, and keeps the forces. To
  /// be followed by record_end() once the velocities have been extrapolated again. `strain_filtered`: the particles are
  /// strained with the filtered velocities (Field::filter).
  void record_start(double dt, bool filtered);
  void record_end(double dt, bool filtered, bool strain_filtered);
  /// With `filtered` velocities: to be called after the update of the particle velocities, which must have recorded
  /// their changes (Gather::record_change).
  void record_change_of_velocities(double dt);

 private:
  template <class F>
  void add(double dt, F&& power);

  System<Dim>& system_;
  const Exchanges<Dim>& exchanges_;
  EnergyLedger& ledger_;
  struct Block {
    std::size_t field, slot;
    double work;
  };
  std::vector<Block> blocks_;  // of all fields
  std::vector<double> by_range_;
  std::vector<Bin> pieces_;
  std::vector<std::vector<Vec3>> forces_;  // per field and node, m a
  bool has_start_ = false;                 // keep_start() was called in this step
};

}  // namespace tribo
