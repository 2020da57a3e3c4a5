// SPDX-License-Identifier: MIT
#include "run/energy_balance.hpp"

namespace tribo {

template <int Dim>
RunEnergies run_energies(const Model& model, const System<Dim>& system, Stepper<Dim>& stepper, const Measures& all) {
  RunEnergies l;
  // Mass times the displacement of the centre of mass
  l.potential = -all.mass * model.body_force.gravity.dot(all.displacement);
  l.external_work = stepper.ledger().external_work;
  l.stages = stepper.ledger().stages;
  l.damping = stepper.ledger().damping_work;
  l.boundary_work = stepper.ledger().rigid_work;
  l.transfer = stepper.ledger().transfer_loss(all.kinetic) + stepper.contact().ledger().nodal_work;
  const PairLedger contact = stepper.contact().ledger().total();
  const auto joints = stepper.joints().energies();
  l.interface = joints.stored;
  l.joint_strain = joints.stored, l.joint_slip = joints.slip, l.joint_dashpot = joints.dashpot;
  l.joint_released = joints.dissipated - joints.slip - joints.dashpot, l.decohesion = joints.decohesion;
  if (system.step > 0) l.grid_kinetic = stepper.grid_kinetic();
  l.contact = contact.friction + contact.impact + contact.interface + joints.dissipated;
  l.boundary_work += stepper.contact().ledger().rigid_work;
  for (std::size_t f = 0; f < system.fields.size(); ++f) l.boundary_work += stepper.conditions(f).work();
  return l;
}

template RunEnergies run_energies<2>(const Model&, const System<2>&, Stepper<2>&, const Measures&);
template RunEnergies run_energies<3>(const Model&, const System<3>&, Stepper<3>&, const Measures&);

}  // namespace tribo
