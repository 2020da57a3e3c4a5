// SPDX-License-Identifier: MIT
#include "solver/rigid/rigid_blocks.hpp"

#include "base/parallel.hpp"
#include "blocks/assembly.hpp"
#include "grid/loops.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

/// Calls f(body, number of its block) for the bodies that represent blocks in the grid.
template <int Dim, class F>
void each_block(System<Dim>& system, F&& f) {
  for (auto& body : system.rigids)
    if (body.block >= 0) f(body, static_cast<std::size_t>(body.block));
}

template <int Dim>
Vec3 in_space(const Vec<Dim>& x) {
  Vec3 out = Vec3::Zero();
  out.head<Dim>() = x;
  return out;
}

}  // namespace

template <int Dim>
void RigidBlocks<Dim>::set_particle_velocities() {
  if (!active()) return;
  each_block(system_, [&](Body<Dim>& body, std::size_t k) {
    const BlockMotion& m = system_.blocks->motion[k];
    const auto v = body.particles.v();
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const Vec3 velocity = m.v + m.w.cross(in_space<Dim>(body.particles.position(i)) - m.x);
      for (std::size_t d = 0; d < Dim; ++d) v[d][i] = velocity[static_cast<Eigen::Index>(d)];
    }
  });
}

template <int Dim>
void RigidBlocks<Dim>::set_nodal_momentum(const Body<Dim>& body) {
  if (body.block < 0) return;
  const BlockMotion& m = system_.blocks->motion[static_cast<std::size_t>(body.block)];
  Field<Dim>& field = system_.fields[body.field];
  for (std::size_t n = 0; n < field.nodes.size(); ++n) {
    Node& node = field.nodes[n];
    if (!(node.mass > 0)) continue;
    const Vec3 x = in_space<Dim>(system_.lattice.position(field.map.node_at(static_cast<std::int64_t>(n))));
    const Vec3 momentum = node.mass * (m.v + m.w.cross(x - m.x));
    for (int d = 0; d < Dim; ++d) node.momentum[d] = momentum[d];
  }
}

template <int Dim>
void RigidBlocks<Dim>::take_contact_forces(const std::vector<RigidExchange>& exchanges, double dt) {
  if (!active()) return;
  each_block(system_, [&](Body<Dim>& body, std::size_t k) {
    GridForce& block_force = system_.blocks->grid_forces[k];
    block_force = {};
    if (exchanges.empty()) return;
    const RigidExchange& exchange = exchanges[body.field];
    block_force.force = exchange.impulse / dt;
    const Vec3& centre = system_.blocks->motion[k].x;
    block_force.moment = (exchange.moment - centre.cross(exchange.impulse)) / dt;
    block_force.spread = (exchange.moment_tensor - exchange.impulse * centre.transpose()) / dt;
    check_stability(body, exchange);
  });
}

// Contact sets the nodes to the velocity of the block before the exchange. This explicit exchange of momentum is
// stable if the largest eigenvalue of the inertia of the nodes in contact, relative to that of the block, is less
// than 2. Of a single node of mass m at the distance r from the centre of a block of mass M and moment of inertia I it
// is m (1/M + r^2/I).
template <int Dim>
void RigidBlocks<Dim>::check_stability(const Body<Dim>& body, const RigidExchange& exchange) const {
  if (exchange.inertia.isZero(0)) return;
  const auto k = static_cast<std::size_t>(body.block);
  const BlockBody& block = system_.blocks->bodies[k];
  // Square root of the inverse inertia of the block, whose held velocities do not react
  Eigen::Matrix<double, 6, 6> root = Eigen::Matrix<double, 6, 6>::Zero();
  for (int d = 0; d < Dim; ++d)
    if (!(block.held & (1 << d))) root(d, d) = 1 / std::sqrt(block.mass);
  if constexpr (Dim == 2) {
    if (!(block.held & 32)) root(5, 5) = 1 / std::sqrt(block.inertia[2]);
  } else {
    const Mat3 axes = system_.blocks->motion[k].R * block.axes;
    const Mat3 free = Vec3((block.held & 8) ? 0 : 1, (block.held & 16) ? 0 : 1, (block.held & 32) ? 0 : 1).asDiagonal();
    root.bottomRightCorner<3, 3>() =
        free * axes * block.inertia.cwiseSqrt().cwiseInverse().asDiagonal() * axes.transpose();
  }
  const Eigen::Matrix<double, 6, 6> relative = root * exchange.inertia * root.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(relative, Eigen::EigenvaluesOnly);
  const double mass_ratio = solver.eigenvalues()[5];
  if (mass_ratio < 2) return;
  throw SimulationError("the mass at the nodes in contact with '" + body.name +
                        "' is too large compared with its own in step " + std::to_string(system_.step + 1) +
                        " at time " + std::to_string(system_.time) +
                        ": the exchange of momentum would be unstable. Blocks must be some cells thick: take smaller "
                        "cells, or model this one as a stiff material.");
}

template <int Dim>
void RigidBlocks<Dim>::advance(double dt) {
  if (!active()) return;
  Assembly& blocks = *system_.blocks;
  before_.clear(), means_.clear();
  for (const BlockMotion& m : blocks.motion) before_.push_back(m.R), means_.emplace_back().x = m.x;
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt / blocks.critical_step() * (1 - 1e-12))));
  const double half = 0.5 / substeps;
  const auto add_velocities = [&] {
    for (std::size_t k = 0; k < means_.size(); ++k)
      means_[k].v += half * blocks.motion[k].v, means_[k].w += half * blocks.motion[k].w;
  };
  for (int substep = 0; substep < substeps; ++substep)
    add_velocities(), blocks.advance(dt / substeps), add_velocities();
  if (!blocks.is_finite())
    throw SimulationError("the motion of the blocks grew without bound at time " + std::to_string(blocks.time));
  if (system_.step % 64 == 0) blocks.check_contacts();
}

template <int Dim>
void RigidBlocks<Dim>::move_particles(Travel& travel) {
  if (!active()) return;
  const Assembly& blocks = *system_.blocks;
  each_block(system_, [&](Body<Dim>& body, std::size_t k) {
    const BlockMotion& m = blocks.motion[k];
    const Mat3 rotation = m.R * before_[k].transpose();
    const auto x = body.particles.x(), origin = body.particles[body.origin];
    const auto F = body.particles.F();
    double most = 0.0;
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      Vec<Dim> start;
      for (std::size_t d = 0; d < Dim; ++d) start[static_cast<Eigen::Index>(d)] = origin[d][i];
      const Vec3 now = m.x + m.R * (in_space<Dim>(start) - blocks.bodies[k].start);
      for (std::size_t d = 0; d < Dim; ++d) {
        const auto axis = static_cast<Eigen::Index>(d);
        most = std::max(most, std::abs(now[axis] - x[d][i]) / system_.lattice.spacing[axis]);
        x[d][i] = now[axis];
      }
      store_full<Dim>(rotation * load_full<Dim>(F, static_cast<int>(i)), F, static_cast<int>(i));
    }
    travel.include(body, most);
  });
}

template class RigidBlocks<2>;
template class RigidBlocks<3>;

}  // namespace tribo
