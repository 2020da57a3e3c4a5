// SPDX-License-Identifier: MIT
/// What a time step records: works, balance of forces, and forces of joints.
#include "solver/step.hpp"

#include "solver/exchange/node_sums.hpp"

namespace tribo {

template <int Dim>
void Stepper<Dim>::record_update(double dt) {
  body_forces_.record(dt);
  const bool again = extrapolates_again();
  again ? tractions_.record_start(dt, filters_update()) : tractions_.record(dt, filters_update());
  if (model_.scheme.order != UpdateOrder::usf) {
    const auto lap = watches_.grid.lap();
    again ? nodal_work_.record_start(dt, filters_update()) : nodal_work_.record(dt, filters_update());
  }
  contact_.record(dt, flip_share(), filters_update());
  if (measures_balance_) record_balance();
}

// Works at the velocities that a filter of the particles' update has changed.
template <int Dim>
void Stepper<Dim>::record_changes(double dt) {
  if (!filters_update()) return;
  if (model_.scheme.order != UpdateOrder::usavg) nodal_work_.record_change_of_velocities(dt);
  tractions_.record_change_of_velocities(dt);
}

template <int Dim>
void Stepper<Dim>::record_balance() {
  NodeSums<Dim> sum(system_, exchanges_);
  WorkAndImpulse all = WorkAndImpulse::Zero();
  const double gravity = model_.body_force.gravity.norm();
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    if (system_.fields[f].rigid_contact) continue;
    all += sum(f, [&](std::int64_t, const Node& node) {
      WorkAndImpulse forces = WorkAndImpulse::Zero();
      forces[0] = node.mass * Eigen::Map<const Vec<Dim>>(node.acceleration).norm();
      forces[1] = Eigen::Map<const Vec<Dim>>(node.force).norm() + node.mass * gravity;
      return forces;
    });
  }
  unbalanced_ratio_ = all[1] > 0 ? all[0] / all[1] : 0.0;
}

template <int Dim>
double Stepper<Dim>::grid_kinetic() {
  if (grid_kinetic_) return *grid_kinetic_;
  NodeSums<Dim> sum(system_, exchanges_);
  double all = 0.0;
  for (std::size_t f = 0; f < system_.fields.size(); ++f)
    all += sum(f, [](std::int64_t, const Node& node) {
      double square = 0.0;
      for (int d = 0; d < Dim; ++d) square += node.velocity[d] * node.velocity[d];
      return WorkAndImpulse(0.5 * node.mass * square, 0, 0, 0);
    })[0];
  return all;
}

template <int Dim>
void Stepper<Dim>::record_joints() {
  joints_.each_pair([&](std::size_t one, std::size_t two, const Vec3& force, double area, double stored) {
    const bool of_crack = one >= system_.fields.size();  // its key is that of the contact pairs of the crack
    const bool swap = one > two && !of_crack;
    PairLedger& entry = contact_.ledger().pairs[swap ? std::pair{two, one} : std::pair{one, two}];
    entry.force += swap ? Vec3(-force) : force;
    entry.area += area, entry.stored += stored;
  });
  const auto [work, impulse] = joints_.take_rigid_exchange();
  contact_.ledger().rigid_work += work, contact_.ledger().rigid_impulse += impulse;
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace tribo
