// SPDX-License-Identifier: MIT
#include "solver/rigid/rigid_bodies.hpp"

#include <cmath>

namespace tribo {

template <int Dim>
void RigidBodies<Dim>::set_velocities(double dt) {
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    auto& body = system_.rigids[r];
    if (body.block >= 0) continue;
    const MaterialSpec& spec = model_.materials[static_cast<std::size_t>(body.material)];
    const auto v = body.particles.v();
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      Vec3 position = Vec3::Zero();
      position.head<Dim>() = body.particles.position(i);
      auto at = Variables::at(position, (system_.time + dt) / model_.units.alternative_time());
      at.dt = dt / model_.units.alternative_time();
      for (std::size_t d = 0; d < Dim; ++d)
        if (spec.rigid_velocity[d]) {
          v[d][i] = (*spec.rigid_velocity[d])(at);
          if (!std::isfinite(v[d][i]))
            throw SimulationError("a velocity function of the rigid material '" + body.name + "' (" +
                                  spec.origin.text() + ") is not a number for particle " +
                                  std::to_string(body.particles.id[i]) + " in step " +
                                  std::to_string(system_.step + 1) + " at time " + std::to_string(system_.time) +
                                  "; check its <SettingFunction>s");
        }
    }
    if (body.field != Body<Dim>::no_field) continue;
    for (auto& field : system_.fields) {
      std::fill(field.rigid[r].begin(), field.rigid[r].end(), PrescribedNode{});
      transfers_.scatter(body, Target<Dim>(field.map, field.rigid[r]), Scatter::momentum, false, false);
    }
  }
}

template <int Dim>
double RigidBodies<Dim>::move(double dt) {
  double travel = 0.0;
  for (auto& body : system_.rigids) {
    if (body.block >= 0) continue;
    const auto x = body.particles.x(), v = body.particles.v();
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d][i] += dt * v[d][i];
        travel = std::max(travel, std::abs(dt * v[d][i]) / system_.lattice.spacing[static_cast<Eigen::Index>(d)]);
      }
  }
  return travel;
}

// For the first node `n` behind the face of a rigid body with mirrored velocities: pointer to the velocity of the node
// in front of the face of which it is the image. Null for all other nodes.
template <int Dim>
const double* RigidBodies<Dim>::mirror_image(const Field<Dim>& field, std::size_t r, std::size_t n, int d) const {
  const int mirrored = model_.materials[static_cast<std::size_t>(system_.rigids[r].material)].mirrored;
  if (mirrored == 0) return nullptr;
  auto at = field.map.node_at(static_cast<std::int64_t>(n));
  at[static_cast<std::size_t>(d)] -= mirrored;
  const auto face = field.map.node(at);
  at[static_cast<std::size_t>(d)] -= mirrored;
  const auto inside = field.map.node(at);
  if (face < 0 || inside < 0) return nullptr;
  const auto i = static_cast<std::size_t>(inside);
  const bool right_beyond = field.rigid[r][static_cast<std::size_t>(face)].mass > 0 && !(field.rigid[r][i].mass > 0);
  return right_beyond && field.nodes[i].mass > 0 ? &field.nodes[i].velocity[d] : nullptr;
}

// Calls f(field, rigid body, position of the node, node, node of the rigid layer, axis, wanted velocity) for every
// velocity component that a rigid body without a field prescribes.
template <int Dim>
template <class F>
void RigidBodies<Dim>::each_prescribed(F&& f) {
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    if (system_.rigids[r].field != Body<Dim>::no_field) continue;
    const auto& sets = model_.materials[static_cast<std::size_t>(system_.rigids[r].material)].sets_velocity;
    for (std::size_t k = 0; k < system_.fields.size(); ++k) {
      Field<Dim>& field = system_.fields[k];
      for (std::size_t n = 0; n < field.nodes.size(); ++n) {
        PrescribedNode& rigid = field.rigid[r][n];
        if (!(rigid.mass > 0) || !(field.nodes[n].mass > 0)) continue;
        for (int d = 0; d < Dim; ++d) {
          if (!sets[static_cast<std::size_t>(d)]) continue;
          const double prescribed = rigid.momentum[d] / rigid.mass;
          const double* image = mirror_image(field, r, n, d);
          f(k, r, n, field.nodes[n], rigid, d, image ? 2 * prescribed - *image : prescribed);
        }
      }
    }
  }
}

template <int Dim>
void RigidBodies<Dim>::impose() {
  each_prescribed([](std::size_t, std::size_t, std::size_t, Node& node, PrescribedNode& rigid, int d, double wanted) {
    rigid.change[d] = wanted - node.velocity[d];
    node.velocity[d] = wanted;
  });
}

template <int Dim>
void RigidBodies<Dim>::impose_update(double dt, bool after_impose) {
  reactions_.assign(system_.rigids.size(), Vec3::Zero());
  each_prescribed(
      [&](std::size_t f, std::size_t r, std::size_t n, Node& node, PrescribedNode& rigid, int d, double wanted) {
        const double change = wanted - node.velocity[d];
        node.velocity[d] = wanted;
        const double correction = (change + (after_impose ? rigid.change[d] : 0.0)) / dt;
        node.acceleration[d] += correction;
        const double force = exchanges_[f]->ownership(static_cast<std::int64_t>(n)) * node.mass * correction;
        reactions_[r][d] += force;
        ledger_.impulse[d] += dt * force;
        ledger_.rigid_work += dt * force * (wanted - 0.5 * dt * node.acceleration[d]);
      });
}

template class RigidBodies<2>;
template class RigidBodies<3>;

}  // namespace tribo
