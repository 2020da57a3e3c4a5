// SPDX-License-Identifier: MIT
#include "solver/loads/particle_loads.hpp"

#include "base/parallel.hpp"
#include "base/ranks.hpp"

#include <cmath>

namespace tribo {
namespace {

constexpr std::size_t most_conditions = 52;  // bits of a double's mantissa

}  // namespace

template <int Dim>
std::vector<double> find_loaded(const Model& model, System<Dim>& system) {
  const auto& conditions = model.particle_conditions;
  std::vector<double> share(conditions.size(), 1.0);
  if (conditions.empty() && !model.stage.loads) return share;
  Problems problems;
  if (conditions.size() > most_conditions)
    problems.add(conditions[most_conditions].origin,
                 "at most " + std::to_string(most_conditions) + " loads and tractions");
  problems.raise();
  for (auto& body : system.bodies)
    if (!body.load_set) body.load_set = body.particles.add("load_set", Dimension::none);
  if (model.stage.number > 0) return share;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    std::size_t found = 0;
    for (auto& body : system.bodies) {
      double* set = body.particles[body.load_set];
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        Vec3 x = Vec3::Zero();
        x.head<Dim>() = body.particles.position(i);
        if (!conditions[c].where->contains(x)) continue;
        set[i] += std::ldexp(1.0, static_cast<int>(c));
        ++found;
      }
    }
    if (found == 0)
      problems.add(
          conditions[c].origin,
          "this load selects no particle: the centre of a particle must lie in the shape, and next to a face it "
          "lies half a particle inside; give a line or arc a larger tolerance, or take a rectangle");
    if (conditions[c].net && found > 0) share[c] = 1.0 / static_cast<double>(found);
  }
  problems.raise();
  return share;
}

template <int Dim>
std::vector<double> mark_loaded(const Model& model, System<Dim>& system, std::vector<Origin>& none) {
  const auto& conditions = model.particle_conditions;
  std::vector<double> share(conditions.size(), 1.0);
  std::vector<std::size_t> found(conditions.size(), 0);
  for (auto& body : system.bodies) {
    if (!body.load_set) continue;
    double* set = body.particles[body.load_set];
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const auto before = static_cast<std::uint64_t>(set[i]);
      Vec3 x = Vec3::Zero();
      x.head<Dim>() = body.particles.position(i);
      std::uint64_t bits = 0;
      for (std::size_t c = 0; c < conditions.size(); ++c) {
        const bool marked = c < model.stage.kept ? (before >> c & 1U) != 0 : conditions[c].where->contains(x);
        if (marked) bits |= std::uint64_t{1} << c, ++found[c];
      }
      set[i] = static_cast<double>(bits);
    }
  }
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    if (found[c] == 0 && c >= model.stage.kept) none.push_back(conditions[c].origin);
    if (conditions[c].net && found[c] > 0) share[c] = 1.0 / static_cast<double>(found[c]);
  }
  return share;
}

template <int Dim>
Vec3 ParticleLoads<Dim>::force_on(Body<Dim>& body, std::size_t i, double dt) const {
  Vec3 sum = Vec3::Zero(), x = Vec3::Zero();
  x.head<Dim>() = body.particles.position(i);
  if (body.load_set) {
    const auto bits = static_cast<std::uint64_t>(body.particles[body.load_set][i]);
    if (bits != 0)
      for (std::size_t c = 0; c < model_.particle_conditions.size(); ++c) {
        const auto& condition = model_.particle_conditions[c];
        if ((bits >> c & 1U) && condition.kind == ParticleCondition::Kind::force)
          sum[static_cast<int>(condition.direction)] +=
              factor_[c] * condition.value.at(system_.load_clock.at(system_.time, model_.reversal), x);
      }
  }
  const BodyForce& force = model_.body_force;
  if (force.acts_on_particles()) {
    const auto origin = body.particles[body.origin];
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
void ParticleLoads<Dim>::apply(double dt) {
  for (auto& body : system_.bodies) {
    if (!body.load) continue;
    const auto load = body.particles[body.load];
    parallel_for(static_cast<std::ptrdiff_t>(body.particles.size()), [&](std::ptrdiff_t k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3 sum = force_on(body, i, dt);
      for (std::size_t d = 0; d < Dim; ++d) load[d][i] = sum[static_cast<Eigen::Index>(d)];
    });
  }
  if (model_.body_force.of_program) add_loads_of_program();
  record(0.5 * dt);
}

template <int Dim>
void ParticleLoads<Dim>::add_loads_of_program() {
  positions_.clear();
  for (auto& body : system_.bodies)
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (const double* x : body.particles.x()) positions_.push_back(x[i]);
  accelerations_.assign(positions_.size(), 0.0);
  model_.body_force.of_program(Dim, positions_, system_.time, accelerations_);
  const double* a = accelerations_.data();
  for (auto& body : system_.bodies) {
    const auto load = body.particles[body.load];
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (double* force : load) force[i] += body.particles.mass()[i] * *a++;
  }
}

template <int Dim>
void ParticleLoads<Dim>::record(double dt) {
  OrderlessSums<4> all;
  bool any = false;
  for (auto& body : system_.bodies) {
    if (!body.load) continue;
    const auto load = body.particles[body.load], v = body.particles.v();
    const auto ranges = body.bins.sum_ranges(body.particles.size(), pieces_);
    partial_.assign(ranges.size(), WorkAndImpulse::Zero());
    any = true;
    parallel_for(static_cast<std::ptrdiff_t>(partial_.size()), [&](std::ptrdiff_t k) {
      const Bin& range = ranges[static_cast<std::size_t>(k)];
      WorkAndImpulse sum = WorkAndImpulse::Zero();
      for (std::uint32_t i = range.begin; i < range.end; ++i)
        for (std::size_t d = 0; d < Dim; ++d)
          sum[0] += load[d][i] * v[d][i], sum[static_cast<Eigen::Index>(1 + d)] += load[d][i];
      partial_[static_cast<std::size_t>(k)] = sum;
    });
    for (const WorkAndImpulse& sum : partial_) all.add(sum);
  }
  if (!any) return;
  const WorkAndImpulse sum = all.total();
  ledger_.external_work += dt * sum[0], ledger_.impulse += dt * sum.template tail<3>();
}

template std::vector<double> find_loaded<2>(const Model&, System<2>&);
template std::vector<double> find_loaded<3>(const Model&, System<3>&);
template std::vector<double> mark_loaded<2>(const Model&, System<2>&, std::vector<Origin>&);
template std::vector<double> mark_loaded<3>(const Model&, System<3>&, std::vector<Origin>&);
template class ParticleLoads<2>;
template class ParticleLoads<3>;

}  // namespace tribo
