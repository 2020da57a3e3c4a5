/// Forces on particles and velocities prescribed by rigid particles.

#include "base/parallel.hpp"
#include "solver/loaded.hpp"
#include "solver/step.hpp"

#include <cmath>

namespace tribo {
namespace {

constexpr std::size_t most_conditions = 52;  // bits of a double's mantissa

}  // namespace

template <int Dim>
std::vector<double> find_loaded(const Model& model, System<Dim>& system) {
  const auto& conditions = model.particle_conditions;
  std::vector<double> share(conditions.size(), 1.0);
  if (conditions.empty()) return share;
  Problems problems;
  if (conditions.size() > most_conditions)
    problems.add(conditions[most_conditions].origin,
                 "at most " + std::to_string(most_conditions) + " loads and tractions");
  problems.raise();
  for (auto& body : system.bodies)
    if (!body.load_set) body.load_set = body.particles.add("load_set", Dimension::none);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    std::size_t found = 0;
    for (auto& body : system.bodies) {
      double* set = body.particles.column(*body.load_set);
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        Vec3 x = Vec3::Zero();
        x.head<Dim>() = body.particles.position(i);
        if (!conditions[c].where->contains(x)) continue;
        set[i] += std::ldexp(1.0, static_cast<int>(c));
        ++found;
      }
    }
    if (found == 0) problems.add(conditions[c].origin, "this load selects no particle");
    if (conditions[c].net && found > 0) share[c] = 1.0 / static_cast<double>(found);
  }
  problems.raise();
  return share;
}

template <int Dim>
Vec3 Stepper<Dim>::load_on(Body<Dim>& body, std::size_t i, double dt) const {
  Vec3 sum = Vec3::Zero(), x = Vec3::Zero();
  x.head<Dim>() = body.particles.position(i);
  if (body.load_set) {
    const auto bits = static_cast<std::uint64_t>(body.particles.column(*body.load_set)[i]);
    if (bits != 0)
      for (std::size_t c = 0; c < model_.particle_conditions.size(); ++c) {
        const auto& condition = model_.particle_conditions[c];
        if ((bits >> c & 1U) && condition.kind == ParticleCondition::Kind::force)
          sum[condition.direction] += load_share_[c] * condition.value.at(system_.time, x);
      }
  }
  const BodyForce& force = model_.body_force;
  if (force.acts_on_particles()) {
    const auto origin = body.particles.vector(*body.origin);
    auto at = Variables::at(x, system_.time / force.function_time);
    at.dt = dt / force.function_time;
    at.x0 = origin[0][i], at.y0 = origin[1][i], at.z0 = Dim == 3 ? origin[Dim - 1][i] : 0.0;
    for (std::size_t d = 0; d < Dim; ++d)
      if (const auto& f = force.on_particles[d])
        sum[static_cast<Eigen::Index>(d)] += body.particles.mass()[i] * (*f)(at);
  }
  return sum;
}

template <int Dim>
void Stepper<Dim>::apply_loads(double dt) {
  for (auto& body : system_.bodies) {
    if (!body.load) continue;
    const auto load = body.particles.vector(*body.load);
    parallel_for(static_cast<std::ptrdiff_t>(body.particles.size()), [&](std::ptrdiff_t k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3 sum = load_on(body, i, dt);
      for (std::size_t d = 0; d < Dim; ++d) load[d][i] = sum[static_cast<Eigen::Index>(d)];
    });
  }
  account_loads(0.5 * dt);
}

// Half of the step's work with the velocities at its start, half with those at its end: second order.
template <int Dim>
void Stepper<Dim>::account_loads(double dt) {
  static constexpr std::ptrdiff_t piece = 4096;
  for (auto& body : system_.bodies) {
    if (!body.load) continue;
    const auto load = body.particles.vector(*body.load), v = body.particles.v();
    const auto n = static_cast<std::ptrdiff_t>(body.particles.size());
    exchanges_.assign(static_cast<std::size_t>((n + piece - 1) / piece), Exchange::Zero());
    parallel_for(static_cast<std::ptrdiff_t>(exchanges_.size()), [&](std::ptrdiff_t k) {
      Exchange sum = Exchange::Zero();
      for (auto i = static_cast<std::size_t>(k * piece); i < static_cast<std::size_t>(std::min(n, (k + 1) * piece));
           ++i)
        for (std::size_t d = 0; d < Dim; ++d)
          sum[0] += load[d][i] * v[d][i], sum[static_cast<Eigen::Index>(1 + d)] += load[d][i];
      exchanges_[static_cast<std::size_t>(k)] = sum;
    });
    for (const Exchange& sum : exchanges_)
      ledger_.external_work += dt * sum[0], ledger_.impulse += dt * sum.template tail<3>();
  }
}

template <int Dim>
void Stepper<Dim>::follow_rigid(double dt) {
  blocks_.set_particles();
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
      std::fill(field.rigid[r].begin(), field.rigid[r].end(), Node{});
      transfers_->scatter(body, Target<Dim>(field.map, field.rigid[r]), Scatter::momentum, false, false);
    }
  }
}

template <int Dim>
void Stepper<Dim>::move_rigid(double dt) {
  rigid_travel_ = blocks_.move(dt);
  for (auto& body : system_.rigids) {
    if (body.block >= 0) continue;
    const auto x = body.particles.x(), v = body.particles.v();
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d][i] += dt * v[d][i];
        rigid_travel_ =
            std::max(rigid_travel_, std::abs(dt * v[d][i]) / system_.lattice.spacing[static_cast<Eigen::Index>(d)]);
      }
  }
}

template <int Dim>
void Stepper<Dim>::impose_rigid(double dt, bool update, bool after_impose) {
  if (update) rigid_reactions_.assign(system_.rigids.size(), Vec3::Zero());
  for (std::size_t r = 0; r < system_.rigids.size(); ++r)
    for (std::size_t f = 0; f < system_.fields.size(); ++f) impose_rigid(f, r, dt, update, after_impose);
}

template <int Dim>
void Stepper<Dim>::impose_rigid(std::size_t f, std::size_t r, double dt, bool update, bool after_impose) {
  Field<Dim>& field = system_.fields[f];
  if (system_.rigids[r].field != Body<Dim>::no_field) return;
  const int directions = model_.materials[static_cast<std::size_t>(system_.rigids[r].material)].rigid_directions;
  const int mirrored = model_.materials[static_cast<std::size_t>(system_.rigids[r].material)].mirrored;
  // Velocity of the node that the one right beyond the face mirrors, or null.
  const auto mirror_image = [&](std::size_t n, int d) -> const double* {
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
  };
  for (std::size_t n = 0; n < field.nodes.size(); ++n) {
    Node& node = field.nodes[n];
    Node& rigid = field.rigid[r][n];
    if (!(rigid.mass > 0) || !(node.mass > 0)) continue;
    for (int d = 0; d < Dim; ++d) {
      if (!(directions >> d & 1)) continue;
      const double prescribed = rigid.velocity[d] / rigid.mass;
      const double* image = mirror_image(n, d);
      const double wanted = image ? 2 * prescribed - *image : prescribed;
      const double change = wanted - node.velocity[d];
      node.velocity[d] = wanted;
      if (!update) {
        rigid.acceleration[d] = change;
        continue;
      }
      const double correction = (change + (after_impose ? rigid.acceleration[d] : 0.0)) / dt;
      node.acceleration[d] += correction;
      const double force = conditions_[f].share(static_cast<std::int64_t>(n)) * node.mass * correction;
      rigid_reactions_[r][d] += force;
      ledger_.impulse[d] += dt * force;
      ledger_.rigid_work += dt * force * (wanted - 0.5 * dt * node.acceleration[d]);
    }
  }
}

template std::vector<double> find_loaded<2>(const Model&, System<2>&);
template std::vector<double> find_loaded<3>(const Model&, System<3>&);
template Vec3 Stepper<2>::load_on(Body<2>&, std::size_t, double) const;
template Vec3 Stepper<3>::load_on(Body<3>&, std::size_t, double) const;
template void Stepper<2>::apply_loads(double);
template void Stepper<3>::apply_loads(double);
template void Stepper<2>::account_loads(double);
template void Stepper<3>::account_loads(double);
template void Stepper<2>::follow_rigid(double);
template void Stepper<2>::move_rigid(double);
template void Stepper<3>::move_rigid(double);
template void Stepper<3>::follow_rigid(double);
template void Stepper<2>::impose_rigid(std::size_t, std::size_t, double, bool, bool);
template void Stepper<3>::impose_rigid(std::size_t, std::size_t, double, bool, bool);
template void Stepper<2>::impose_rigid(double, bool, bool);
template void Stepper<3>::impose_rigid(double, bool, bool);

}  // namespace tribo
