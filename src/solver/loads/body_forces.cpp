// SPDX-License-Identifier: MIT
#include "solver/loads/body_forces.hpp"

namespace tribo {

template <int Dim>
Vec3 BodyForces<Dim>::at(const Vec<Dim>& place, double dt) const {
  Vec3 x = Vec3::Zero(), a = Vec3::Zero();
  x.head<Dim>() = place;
  auto at = Variables::at(x, system_.time / force_.function_time);
  at.dt = dt / force_.function_time;
  for (int d = 0; d < Dim; ++d)
    if (const auto& function = force_.function[static_cast<std::size_t>(d)]) a[d] = (*function)(at);
  return a;
}

template <int Dim>
void BodyForces<Dim>::apply(std::size_t f, double dt) {
  if (!active()) return;
  const auto& field = system_.fields[f];
  sum_(f, [&](std::int64_t n, Node& node) {
    const Vec3 a = at(system_.lattice.position(field.map.node_at(n)), dt);
    for (int d = 0; d < Dim; ++d) node.acceleration[d] += a[d], node.velocity[d] += dt * a[d];
    return WorkAndImpulse(WorkAndImpulse::Zero());
  });
}

template <int Dim>
void BodyForces<Dim>::record(double dt) {
  if (!active()) return;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& field = system_.fields[f];
    if (field.rigid_contact) continue;
    const WorkAndImpulse sum = sum_(f, [&](std::int64_t n, const Node& node) {
      const Vec3 a = at(system_.lattice.position(field.map.node_at(n)), dt);
      WorkAndImpulse power = WorkAndImpulse::Zero();
      for (int d = 0; d < Dim; ++d) {
        power[0] += node.mass * a[d] * (node.velocity[d] - 0.5 * dt * node.acceleration[d]);
        power[1 + d] += node.mass * a[d];
      }
      return WorkAndImpulse(dt * power);
    });
    ledger_.external_work += sum[0];
    ledger_.impulse += sum.tail<3>();
  }
}

template class BodyForces<2>;
template class BodyForces<3>;

}  // namespace tribo
