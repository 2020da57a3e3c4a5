// SPDX-License-Identifier: MIT
#include "solver/loads/tractions.hpp"

#include "base/ranks.hpp"
#include "solver/loads/face_points.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

template <int Dim>
Vec<Dim> end_velocity(const Field<Dim>& field, std::size_t n) {
  return Eigen::Map<const Vec<Dim>>(field.nodes[n].velocity);
}

template <int Dim>
Vec<Dim> start_velocity(const Field<Dim>& field, std::size_t n) {
  return field.start_velocities[n].template head<Dim>();
}

template <int Dim>
Vec<Dim> acceleration(const Field<Dim>& field, std::size_t n) {
  return Eigen::Map<const Vec<Dim>>(field.nodes[n].acceleration);
}

}  // namespace

template <int Dim>
Tractions<Dim>::Tractions(const Model& model, System<Dim>& system, const Exchanges<Dim>& exchanges,
                          const Cracks<Dim>& cracks, EnergyLedger& ledger)
    : model_(model),
      system_(system),
      exchanges_(exchanges),
      cracks_(cracks),
      ledger_(ledger),
      any_(std::ranges::any_of(model.particle_conditions, [](const ParticleCondition& condition) {
        return condition.kind == ParticleCondition::Kind::traction;
      })) {}

template <int Dim>
void Tractions<Dim>::apply(const ParticleCondition& condition, Body<Dim>& body, std::size_t i) {
  const auto face = ParticleFace<Dim>::of(system_, body, i, condition.face);
  const Vec3 direction = condition.direction == LoadDirection::normal ? face.normal
                         : condition.direction == LoadDirection::tangential
                             ? Vec3(face.normal.cross(Vec3::UnitZ()) * -1.0)
                             : Vec3(Mat3::Identity().col(static_cast<int>(condition.direction)));
  ConditionPoint point{.time = system_.load_clock.at(system_.time, model_.reversal)};
  Vec3 v = Vec3::Zero(), start = Vec3::Zero();
  point.position.head<Dim>() = body.particles.position(i);
  v.head<Dim>() = body.particles.velocity(i);
  for (int d = 0; d < Dim; ++d) start[d] = body.particles[body.origin][static_cast<std::size_t>(d)][i];
  point.velocity = v.dot(direction);
  point.displacement = (point.position - start).dot(direction);
  point.impedance = std::sqrt(body.law->density() * body.law->wave_modulus());
  const double traction = condition.value.at(point);
  const Vec3 force = face.area * traction / static_cast<double>(face.points.size()) * direction;
  const bool is_ghost = i >= body.particles.size();
  if (!is_ghost) particles_.push_back({&body, i, face.area * traction * direction.head<Dim>(), v.head<Dim>()});
  thread_local typename Cracks<Dim>::NodeBox nodes;
  for (const auto& at : face.points) {
    typename Cracks<Dim>::PointSides sides;
    if (cracks_.active()) {
      cracks_.find_nodes(at, nodes);
      sides = cracks_.sides_of(nodes, at);
    }
    // the side of the crack on which the face lies may differ from that of the particle centre
    const auto field_at = [&](const Index<Dim>& node) {
      const int side = cracks_.active() ? cracks_.side_of_node(sides, node) : 0;
      return side == 0 ? body.field : body.across_fields[static_cast<std::size_t>(side) - 1];
    };
    const PointShares<Dim> to(model_.scheme.kernel, system_.fields, exchanges_, at, field_at);
    for (std::size_t k = 0; k < static_cast<std::size_t>(to.count); ++k) {
      Node& node = system_.fields[to.field[k]].nodes[static_cast<std::size_t>(to.node[k])];
      for (int d = 0; d < Dim; ++d) node.force[d] += to.share[k] * force[d];
      if (system_.fields[to.field[k]].map.is_own(static_cast<std::size_t>(to.node[k]) / block_nodes<Dim>))
        forces_.push_back({to.field[k], to.node[k], to.share[k] * force.head<Dim>()});
    }
  }
}

template <int Dim>
void Tractions<Dim>::apply() {
  forces_.clear(), particles_.clear();
  each_loaded(model_, system_, ParticleCondition::Kind::traction,
              [&](const ParticleCondition& condition, Body<Dim>& body, std::size_t particle) {
                apply(condition, body, particle);
              });
}

template <int Dim>
template <class F>
void Tractions<Dim>::add_work(double dt, F&& velocity) {
  if (!any_) return;
  OrderlessSums<1> power;
  for (const NodalForce& applied : forces_) {
    const Vec<Dim> v = velocity(system_.fields[applied.field], static_cast<std::size_t>(applied.node));
    power.add(applied.force.dot(v));
  }
  ledger_.external_work += dt * power.total()[0];
}

template <int Dim>
void Tractions<Dim>::add_impulse(double dt) {
  if (!any_) return;
  OrderlessSums<Dim> force;
  for (const NodalForce& applied : forces_) force.add(applied.force);
  ledger_.impulse.template head<Dim>() += dt * force.total();
}

template <int Dim>
void Tractions<Dim>::record(double dt, bool filtered) {
  const double since_middle = filtered ? 0.0 : 0.5 * dt;
  add_work(dt, [&](const Field<Dim>& field, std::size_t n) -> Vec<Dim> {
    if (knows_start()) return 0.5 * (start_velocity(field, n) + end_velocity(field, n));
    return end_velocity(field, n) - since_middle * acceleration(field, n);
  });
  add_impulse(dt);
}

template <int Dim>
void Tractions<Dim>::record_start(double dt, bool filtered) {
  if (knows_start())
    add_work(0.5 * dt, start_velocity<Dim>);
  else if (!filtered)
    add_work(0.5 * dt, [&](const Field<Dim>& field, std::size_t n) -> Vec<Dim> {
      return end_velocity(field, n) - dt * acceleration(field, n);
    });
  add_impulse(dt);
}

template <int Dim>
void Tractions<Dim>::record_end(double dt, bool filtered, bool strain_filtered) {
  add_work(filtered && !knows_start() ? dt : 0.5 * dt, [&](const Field<Dim>& field, std::size_t n) -> Vec<Dim> {
    return strain_filtered ? Vec<Dim>(Eigen::Map<const Vec<Dim>>(field.filter[n].velocity)) : end_velocity(field, n);
  });
}

template <int Dim>
void Tractions<Dim>::record_change_of_velocities(double dt) {
  if (!any_) return;
  OrderlessSums<1> power;
  for (const LoadedParticle& p : particles_)
    power.add(p.force.dot(p.body->particles.velocity(p.particle) - p.velocity));
  ledger_.external_work -= 0.5 * dt * power.total()[0];
}

template class Tractions<2>;
template class Tractions<3>;

}  // namespace tribo
