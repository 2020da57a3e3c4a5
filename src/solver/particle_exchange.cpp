// SPDX-License-Identifier: MIT
#include "solver/particle_exchange.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribo {
namespace {

constexpr double failed = 0.999;  // damage

template <int Dim>
const double* history_column(const Body<Dim>& body, std::string_view name) {
  const auto& variables = body.law->history();
  for (std::size_t k = 0; k < variables.size(); ++k)
    if (variables[k].name == name) return body.particles.column(body.history + k);
  return nullptr;
}

}  // namespace

template <int Dim>
ParticleExchange<Dim>::ParticleExchange(const Model& model, System<Dim>& system) : model_(model), system_(system) {}

template <int Dim>
bool ParticleExchange<Dim>::is_outside(const Vec<Dim>& x) const {
  for (int d = 0; d < Dim; ++d)
    if (!model_.grid.periodic[static_cast<std::size_t>(d)] &&
        (x[d] < system_.lattice.low[d] || x[d] > system_.lattice.high[d]))
      return true;
  return false;
}

template <int Dim>
void ParticleExchange<Dim>::find_leaving() {
  leaving_.clear();
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (Body<Dim>& body : *bodies) {
      if (body.block >= 0) continue;
      Leaving leaving{&body, {}, 0, 0};
      for (const DeletionSpec& spec : model_.deletions) {
        if (spec.material != body.material || body.particles.size() == 0) continue;
        const bool all = spec.time >= 0 && system_.time >= spec.time;
        const double *damage = history_column(body, "damage"), *opening = history_column(body, "crack_opening");
        for (std::uint32_t i = 0; i < body.particles.size(); ++i)
          if (all || (damage && damage[i] > failed && (!(spec.opening > 0) || (opening && opening[i] >= spec.opening))))
            leaving.particles.push_back(i);
      }
      leaving.failed = static_cast<std::int64_t>(leaving.particles.size());
      if (model_.delete_leaving)
        for (std::uint32_t i = 0; i < body.particles.size(); ++i)
          if (is_outside(body.particles.position(i))) leaving.particles.push_back(i), ++leaving.outside;
      if (leaving.particles.empty()) continue;
      std::sort(leaving.particles.begin(), leaving.particles.end());
      leaving.particles.erase(std::unique(leaving.particles.begin(), leaving.particles.end()), leaving.particles.end());
      leaving_.push_back(std::move(leaving));
    }
}

template <int Dim>
bool ParticleExchange<Dim>::find(double dt) {
  find_leaving();
  entering_.clear();
  for (std::size_t k = 0; k < system_.inflow.size(); ++k) {
    Inflow<Dim>& inflow = system_.inflow[k];
    const SourceSpec& source = model_.sources[inflow.source];
    inflow.travel += dt * source.speed(system_.time);
    if (inflow.travel >= source.size * (1 - 1e-12) && source.speed(system_.time) > 0) entering_.push_back(k);
  }
  return !leaving_.empty() || !entering_.empty();
}

template <int Dim>
void ParticleExchange<Dim>::remove(const Leaving& leaving) {
  Body<Dim>& body = *leaving.body;
  std::vector<std::uint32_t> all(body.particles.size()), stays;
  std::iota(all.begin(), all.end(), 0U);
  std::set_difference(all.begin(), all.end(), leaving.particles.begin(), leaving.particles.end(),
                      std::back_inserter(stays));
  body.particles.reorder(stays);
  body.weigh();
}

// The row enters where it would be if it had passed the inlet within the step.
template <int Dim>
void ParticleExchange<Dim>::inject(Inflow<Dim>& inflow) {
  const SourceSpec& source = model_.sources[inflow.source];
  Body<Dim>& body = (inflow.row.rigid ? system_.rigids : system_.bodies)[inflow.row.body];
  std::int64_t next = 0;
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (const Body<Dim>& one : *bodies)
      for (const std::int64_t id : one.particles.id) next = std::max(next, id + 1);
  Particles<Dim> row = inflow.row.particles;
  inflow.travel = std::min(inflow.travel - source.size, source.size * (1 - 1e-12));
  const double speed = source.speed(system_.time);
  for (std::size_t i = 0; i < row.size(); ++i) {
    row.id[i] = next + static_cast<std::int64_t>(i);
    for (std::size_t d = 0; d < Dim; ++d) {
      const double n = source.direction[static_cast<Eigen::Index>(d)];
      row.x()[d][i] += inflow.travel * n, row[body.origin][d][i] += inflow.travel * n;
      row.v()[d][i] = speed * n;
    }
  }
  std::vector<std::uint32_t> all(row.size());
  std::iota(all.begin(), all.end(), 0U);
  body.particles.append(row, all);
  body.weigh();
  system_.entered += static_cast<std::int64_t>(row.size());
}

template <int Dim>
void ParticleExchange<Dim>::apply() {
  for (const Leaving& leaving : leaving_)
    system_.deleted_failed += leaving.failed, system_.deleted_outside += leaving.outside;
  if (model_.delete_leaving && system_.deleted_outside > model_.leave_limit.value_or(0))
    throw CommonError("more than " + std::to_string(model_.leave_limit.value_or(0)) +
                      " particles have left the grid, the number of <LeaveLimit>");
  for (const Leaving& leaving : leaving_) remove(leaving);
  for (const std::size_t k : entering_) inject(system_.inflow[k]);
  system_.sorted = false;
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (Body<Dim>& body : *bodies) body.refresh();
}

template class ParticleExchange<2>;
template class ParticleExchange<3>;

}  // namespace tribo
