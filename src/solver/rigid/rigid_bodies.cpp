// SPDX-License-Identifier: MIT
#include "solver/rigid/rigid_bodies.hpp"

#include "base/expression_text.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

namespace {

// Whether the prescribed velocity depends on the position.
bool varies_in_space(const MaterialSpec& spec) {
  return std::any_of(spec.rigid_velocity.begin(), spec.rigid_velocity.end(),
                     [](const auto& f) { return f && check_expression(f->text(), Origin{}).uses_place; });
}

template <int Dim, class Columns>
Vec3 vector_at(const Columns& column, std::size_t i) {
  Vec3 v = Vec3::Zero();
  for (std::size_t d = 0; d < Dim; ++d) v[static_cast<Eigen::Index>(d)] = column[d][i];
  return v;
}

}  // namespace

template <int Dim>
RigidBodies<Dim>::RigidBodies(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers,
                              const Exchanges<Dim>& exchanges, Distribution<Dim>& distribution, EnergyLedger& ledger)
    : model_(model),
      system_(system),
      transfers_(transfers),
      exchanges_(exchanges),
      distribution_(distribution),
      ledger_(ledger) {
  for (const auto& body : system.rigids)
    varies_.push_back(varies_in_space(model.materials[static_cast<std::size_t>(body.material)]));
}

// The prescribed velocity at a position at the end of a step; components without a function are those of `otherwise`.
template <int Dim>
Vec3 RigidBodies<Dim>::wanted(const MaterialSpec& spec, const Vec3& position, const Vec3& otherwise, double dt) const {
  const LoadClock& clock = system_.load_clock;
  const double time = system_.time + dt, rate = clock.rate(time, model_.reversal);
  auto at = Variables::at(position, clock.at(time, model_.reversal) / model_.units.alternative_time());
  at.dt = dt / model_.units.alternative_time();
  Vec3 v = otherwise;
  for (std::size_t d = 0; d < Dim; ++d)
    if (spec.rigid_velocity[d]) v[static_cast<Eigen::Index>(d)] = rate * (*spec.rigid_velocity[d])(at);
  return v;
}

// The domains move with the particles: F <- (1 + dt L + dt^2/2 L^2) F, the gradient of the motion x + dt v(x + dt/2 v)
// for a velocity v with the gradient L.
template <int Dim>
void RigidBodies<Dim>::deform(Body<Dim>& body, double dt) {
  const MaterialSpec& spec = model_.materials[static_cast<std::size_t>(body.material)];
  const auto F = body.particles.F();
  if (!F[0]) return;
  const auto x = body.particles.x(), v = body.particles.v();
  const double distance = 1e-3 * system_.lattice.spacing.minCoeff();
  parallel_for(static_cast<std::ptrdiff_t>(body.particles.size()), [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3 position = vector_at<Dim>(x, i), otherwise = vector_at<Dim>(v, i);
    const Vec3 here = wanted(spec, position, otherwise, dt);
    Mat3 L = Mat3::Zero();
    for (int d = 0; d < Dim; ++d)
      L.col(d) = (wanted(spec, position + distance * Vec3::Unit(d), otherwise, dt) - here) / distance;
    const Mat3 growth = Mat3::Identity() + dt * L + 0.5 * dt * dt * L * L;
    store_full<Dim>(growth * load_full<Dim>(F, static_cast<int>(i)), F, static_cast<int>(i));
  });
}

template <int Dim>
void RigidBodies<Dim>::locate() {
  prescribed_.resize(system_.rigids.size(), PrescribedNodes{BlockMap<Dim>(system_.lattice), {}});
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    const auto& body = system_.rigids[r];
    if (body.field != Body<Dim>::no_field) continue;
    prescribed_[r].map.rebuild(body.bins.reach(system_.lattice, transfers_.stencil_width()));
    prescribed_[r].nodes.resize(static_cast<std::size_t>(prescribed_[r].map.node_count()));
  }
}

template <int Dim>
void RigidBodies<Dim>::set_velocities(double dt) {
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    auto& body = system_.rigids[r];
    if (body.block >= 0) continue;
    const MaterialSpec& spec = model_.materials[static_cast<std::size_t>(body.material)];
    const auto x = body.particles.x(), v = body.particles.v();
    if (const auto& control = model_.load_control; control && control->material == body.material)
      std::fill_n(v[static_cast<std::size_t>(control->axis)], body.particles.size(), system_.load_controller.velocity);
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const Vec3 position = vector_at<Dim>(x, i), before = vector_at<Dim>(v, i);
      Vec3 now = wanted(spec, position, before, dt);
      if (varies_[r]) now = wanted(spec, position + 0.5 * dt * now, before, dt);
      for (std::size_t d = 0; d < Dim; ++d)
        if (spec.rigid_velocity[d]) v[d][i] = now[static_cast<Eigen::Index>(d)];
    }
  }
  const auto has_no_field = [](const Body<Dim>& body) { return body.field == Body<Dim>::no_field; };
  if (std::ranges::any_of(system_.rigids, has_no_field)) distribution_.refresh_ghosts();
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    auto& body = system_.rigids[r];
    if (body.block >= 0 || !has_no_field(body)) continue;
    PrescribedNodes& prescribed = prescribed_[r];
    std::fill(prescribed.nodes.begin(), prescribed.nodes.end(), PrescribedNode{});
    transfers_.scatter(body, Target<Dim>(prescribed.map, prescribed.nodes), Scatter::momentum, false, false);
  }
}

template <int Dim>
void RigidBodies<Dim>::move(double dt, Travel& travel) {
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    auto& body = system_.rigids[r];
    if (body.block >= 0) continue;
    if (varies_[r]) deform(body, dt);
    const auto x = body.particles.x(), v = body.particles.v();
    double most = 0.0;
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d][i] += dt * v[d][i];
        most = std::max(most, std::abs(dt * v[d][i]) / system_.lattice.spacing[static_cast<Eigen::Index>(d)]);
      }
    travel.include(body, most);
  }
}

// For the first node `n` behind the face of a rigid body with mirrored velocities: pointer to the velocity of the node
// in front of the face of which it is the image. Null for all other nodes.
template <int Dim>
const double* RigidBodies<Dim>::mirror_image(const Field<Dim>& field, std::size_t r, std::size_t n, int d) const {
  const int mirrored = model_.materials[static_cast<std::size_t>(system_.rigids[r].material)].mirrored;
  if (mirrored == 0) return nullptr;
  const PrescribedNodes& prescribed = prescribed_[r];
  const auto is_prescribed = [&](const Index<Dim>& at) {
    const auto node = prescribed.map.node(at);
    return node >= 0 && prescribed.nodes[static_cast<std::size_t>(node)].mass > 0;
  };
  auto at = field.map.node_at(static_cast<std::int64_t>(n));
  at[static_cast<std::size_t>(d)] -= mirrored;
  if (!is_prescribed(at)) return nullptr;
  at[static_cast<std::size_t>(d)] -= mirrored;
  const auto inside = field.map.node(at);
  if (inside < 0 || is_prescribed(at)) return nullptr;
  const Node& node = field.nodes[static_cast<std::size_t>(inside)];
  return node.mass > 0 ? &node.velocity[d] : nullptr;
}

// Calls f(field, rigid body, node, its values, axis, wanted velocity) for every velocity component that a rigid body
// without a field prescribes.
template <int Dim>
template <class F>
void RigidBodies<Dim>::each_prescribed(F&& f) {
  for (std::size_t r = 0; r < system_.rigids.size(); ++r) {
    if (system_.rigids[r].field != Body<Dim>::no_field) continue;
    const auto& sets = model_.materials[static_cast<std::size_t>(system_.rigids[r].material)].sets_velocity;
    const PrescribedNodes& prescribed = prescribed_[r];
    for (std::size_t k = 0; k < system_.fields.size(); ++k) {
      Field<Dim>& field = system_.fields[k];
      for (std::size_t s = 0; s < field.map.active().size(); ++s) {
        const int slot = prescribed.map.slot(system_.lattice.block_at(field.map.active()[s]));
        if (slot < 0) continue;
        const PrescribedNode* rigid = &prescribed.nodes[static_cast<std::size_t>(slot) * block_nodes<Dim>];
        for (std::size_t n = s * block_nodes<Dim>; n < (s + 1) * block_nodes<Dim>; ++n, ++rigid) {
          if (!(rigid->mass > 0) || !(field.nodes[n].mass > 0)) continue;
          for (int d = 0; d < Dim; ++d) {
            if (!sets[static_cast<std::size_t>(d)]) continue;
            const double velocity = rigid->momentum[d] / rigid->mass;
            const double* image = mirror_image(field, r, n, d);
            f(k, r, n, field.nodes[n], d, image ? 2 * velocity - *image : velocity);
          }
        }
      }
    }
  }
}

template <int Dim>
void RigidBodies<Dim>::impose() {
  changes_.clear();
  each_prescribed([&](std::size_t, std::size_t, std::size_t, Node& node, int d, double wanted) {
    changes_.push_back(wanted - node.velocity[d]);
    node.velocity[d] = wanted;
  });
}

template <int Dim>
void RigidBodies<Dim>::impose_update(double dt, bool after_impose) {
  reactions_.assign(system_.rigids.size(), Vec3::Zero());
  if (reactions_.empty()) return;
  const std::size_t power = 3 * reactions_.size();  // its number in the sums, after the components of the reactions
  sums_.start(power + 1);
  auto before = changes_.begin();  // of the same components in the same order, as the nodes have the same masses
  each_prescribed([&](std::size_t f, std::size_t r, std::size_t n, Node& node, int d, double wanted) {
    const double change = wanted - node.velocity[d];
    node.velocity[d] = wanted;
    const double correction = (change + (after_impose ? *before++ : 0.0)) / dt;
    node.acceleration[d] += correction;
    if (!system_.fields[f].map.is_own(n / block_nodes<Dim>)) return;
    const double force = exchanges_[f]->ownership(static_cast<std::int64_t>(n)) * node.mass * correction;
    sums_.add(3 * r + static_cast<std::size_t>(d), force);
    sums_.add(power, force * (wanted - 0.5 * dt * node.acceleration[d]));
  });
  sums_.finish();
  for (std::size_t r = 0; r < reactions_.size(); ++r) {
    reactions_[r] = Vec3(sums_[3 * r], sums_[3 * r + 1], sums_[3 * r + 2]);
    ledger_.impulse += dt * reactions_[r];
  }
  ledger_.rigid_work += dt * sums_[power];
}

template class RigidBodies<2>;
template class RigidBodies<3>;

}  // namespace tribo
