// SPDX-License-Identifier: MIT
/// Conduction of heat between the particles of each velocity field, and across the contact of two.
///
///   C_I T_I = sum_p w_Ip m_p c (T_p + (x_I - x_p) . grad T_p),      C_I = sum_p w_Ip m_p c
///   C_I dT_I/dt = sum_p V_p q_p . grad w_Ip + sources,              q = -k grad T
///   T_p <- T_p + dt sum_I w_Ip dT_I/dt
///
/// Explicit, with the gradient that the nodes gave the particles at the end of the step before: the counterpart of
/// the momentum balance with stress last. Nairn & Guilkey, Int. J. Numer. Meth. Engng 102 (2015) 1347-1372. What
/// differs within a cell is not seen by the nodes; it dies out at the rate of conduction in a cell, s = t k / (rho c
/// h^2):
///
///   T_p <- T_p - (1 - S S+) s (1 - S S+) T_p
///
/// Both keep the heat m c T of the particles to round-off.
#pragma once

#include "solver/contact/contact.hpp"
#include "solver/transfer/transfer.hpp"

namespace tribo {

template <int Dim>
class HeatConduction {
 public:
  /// Throws InputError for a condition that selects no node.
  HeatConduction(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers);

  bool active() const { return active_; }
  /// Makes room on the present nodes; after every change of the fields' maps.
  void locate();
  /// One step of the temperatures, with the particles still where the step found them. Sliding contact gives its work
  /// of this step as heat if the model says so. Faces that touch have one temperature; faces apart exchange nothing.
  void conduct(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);

  double supplied = 0.0;              ///< heat that came in through conditions so far    [energy]
  double from_contact = 0.0;          ///< heat from sliding contact so far               [energy]
  double time_since_reduction = 0.0;  ///< time since the detail was last reduced [time]

  friend void archive(Archive& a, HeatConduction& heat) {
    auto& [supplied, from_contact, time_since_reduction, model, system, transfers, active, prescribed] = heat;
    a.version(1);
    a("supplied", supplied), a("from_contact", from_contact), a("time_since_reduction", time_since_reduction);
  }

 private:
  struct PrescribedTemperature {
    Index<Dim> index;
    std::size_t condition;
  };
  HeatNode& node_of(const ContactMember& m) { return system_.fields[m.field].heat[static_cast<std::size_t>(m.node)]; }
  void find_rates(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);
  void add_flux(double dt, const ParticleCondition& condition, Body<Dim>& body, std::size_t particle,
                const Exchanges<Dim>& exchanges);
  void add_friction_heat(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);
  void equalize_contact(const Contact<Dim>& contact);
  void impose_temperatures(double dt, const Exchanges<Dim>& exchanges);
  void update_particles(double dt, const Exchanges<Dim>& exchanges);
  void reduce_detail(double dt, const Contact<Dim>& contact, const Exchanges<Dim>& exchanges);
  void scatter(Scatter what);

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  bool active_ = false;
  std::vector<PrescribedTemperature> prescribed_;  ///< nodes with prescribed temperature
};

}  // namespace tribo
