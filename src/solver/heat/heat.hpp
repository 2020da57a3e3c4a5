// SPDX-License-Identifier: MIT
/// Heat conduction within each velocity field, and between two fields in contact.
///
///   C_I T_I = sum_p w_Ip m_p c (T_p + (x_I - x_p) . grad T_p),      C_I = sum_p w_Ip m_p c
///   C_I dT_I/dt = sum_p V_p q_p . grad w_Ip + sources,              q = -k grad T
///   T_p <- T_p + dt sum_I w_Ip dT_I/dt
///
/// The scheme is explicit and uses the particle gradients from the end of the previous step, like the momentum balance
/// with stress updated last. Nairn & Guilkey, Int. J. Numer. Meth. Engng 102 (2015) 1347-1372. The temperature
/// residual (1 - S S+) T_p, the particle temperature minus the interpolated nodal temperature, does not affect the
/// nodes. It is reduced at the rate of conduction within a cell, by the fraction s = t k / (rho c h^2):
///
///   T_p <- T_p - (1 - S S+) s (1 - S S+) T_p
///
/// S interpolates from nodes to particles, and S+ is the mass-weighted average from particles to nodes. Both updates
/// conserve the heat m c T of the particles to round-off.
#pragma once

#include "solver/contact/contact.hpp"
#include "solver/state/system_loops.hpp"
#include "solver/transfer/system_transfers.hpp"

namespace tribo {

/// Explicit heat conduction, one step at a time.
template <int Dim>
class HeatConduction {
 public:
  /// Throws InputError if a temperature condition selects no node.
  HeatConduction(const Model& model, System<Dim>& system, const SystemLoops<Dim>& loops,
                 SystemTransfers<Dim>& transfers);

  bool active() const { return active_; }
  /// Allocates the nodal temperatures. To be called after every change of the block maps of the fields.
  void locate();
  /// Advances the temperatures by a time step dt, with the particles at their positions at the start of the step.
  /// Frictional work of this step becomes heat if the model requests it. Closed contact faces have the same
  /// temperature; open ones exchange no heat.
  void conduct(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);

  double supplied = 0.0;      ///< heat supplied by boundary conditions since the start of the run    [energy]
  double from_contact = 0.0;  ///< heat from frictional sliding since the start of the run               [energy]
  double time_since_reduction = 0.0;  ///< time since the temperature residual was last reduced [time]

  friend void archive(Archive& a, HeatConduction& heat) {
    auto& [its_supplied, its_contact_heat, its_time, model, system, loops, transfers, active, prescribed] = heat;
    a.version(1);
    a("supplied", its_supplied), a("from_contact", its_contact_heat), a("time_since_reduction", its_time);
  }

 private:
  struct PrescribedTemperature {
    Index<Dim> index;
    std::size_t condition;
  };
  HeatNode& node_of(const ContactMember& m) { return system_.fields[m.field].heat[static_cast<std::size_t>(m.node)]; }
  void find_rates(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);
  void add_fluxes(double dt, const Exchanges<Dim>& exchanges);
  double add_flux(const ParticleCondition& condition, Body<Dim>& body, std::size_t particle,
                  const Exchanges<Dim>& exchanges);
  void add_friction_heat(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);
  void equalize_contact(const Contact<Dim>& contact);
  void impose_temperatures(double dt, const Exchanges<Dim>& exchanges);
  void update_particles(double dt, const Exchanges<Dim>& exchanges);
  void reduce_residual(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);
  void scatter(Scatter what);
  void gather(const Gather& what);
  template <class F>
  void each_node(F&& f);

  const Model& model_;
  System<Dim>& system_;
  const SystemLoops<Dim>& loops_;
  SystemTransfers<Dim>& transfers_;
  bool active_ = false;
  std::vector<PrescribedTemperature> prescribed_;  ///< nodes with prescribed temperature
};

}  // namespace tribo
