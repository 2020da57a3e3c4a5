// SPDX-License-Identifier: MIT
#include "solver/loads/damping.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
void VelocityDamping<Dim>::record_grid(std::size_t f, double dt) {
  const WorkAndImpulse sum = sum_(f, [&](std::int64_t, const Node& node) {
    WorkAndImpulse taken = WorkAndImpulse::Zero();
    for (int d = 0; d < Dim; ++d) {
      const double old = node.velocity[d] - dt * node.acceleration[d];
      taken[0] += old * (node.velocity[d] + old) * 0.5;
      taken[1 + d] += old;
    }
    return WorkAndImpulse(dt * grid * node.mass * taken);
  });
  ledger_.damping_work += sum[0];
  ledger_.impulse -= sum.tail<3>();
}

template <int Dim>
void VelocityDamping<Dim>::record_particles(const Body<Dim>& body, double kinetic, double rate, double dt, bool part) {
  double field_mass = 0.0;
  for (const auto& other : system_.bodies)
    if (other.field == body.field) field_mass += other.total_mass;
  if (!(field_mass > 0)) return;  // all of it was excavated
  const auto& filter = system_.fields[body.field].filter;
  const WorkAndImpulse sum = sum_(body.field, [&](std::int64_t n, const Node& node) {
    WorkAndImpulse momentum = WorkAndImpulse::Zero();
    const double* v = part ? filter[static_cast<std::size_t>(n)].increment : node.velocity;
    for (int d = 0; d < Dim; ++d) {
      momentum[0] += node.mass * v[d] * v[d];
      momentum[1 + d] = node.mass * v[d];
    }
    return momentum;
  });
  // The velocity that particles lose is interpolated from the nodes and cannot have more energy than they have. The
  // nodal velocities may have: those of nodes that few particles reach, with forces out of balance.
  const double of_body = body.total_mass / field_mass, squares = std::min(of_body * sum[0], 2 * kinetic);
  const double share = rate * dt * of_body, work = rate * dt * (1 - 0.5 * rate * dt) * squares;
  ledger_.damping_work += work, ledger_.particle_loss += work;
  ledger_.impulse -= share * sum.tail<3>();
}

template class VelocityDamping<2>;
template class VelocityDamping<3>;

}  // namespace tribo
