// SPDX-License-Identifier: MIT
#include "solver/loads/nodal_work.hpp"

#include "base/parallel.hpp"
#include "base/ranks.hpp"

namespace tribo {

// Sums power(field, number, node) over the nodes of each block, and over the blocks in any order.
template <int Dim>
template <class F>
void NodalWork<Dim>::add(double dt, F&& power) {
  blocks_.clear();
  for (std::size_t f = 0; f < system_.fields.size(); ++f)
    for (std::size_t b = 0; b < system_.fields[f].map.active().size() && !system_.fields[f].rigid_contact; ++b)
      blocks_.push_back({f, b, 0.0});
  parallel_for(static_cast<std::ptrdiff_t>(blocks_.size()), [&](std::ptrdiff_t k) {
    Block& block = blocks_[static_cast<std::size_t>(k)];
    const auto& field = system_.fields[block.field];
    const Exchange<Dim>& exchange = *exchanges_[block.field];
    field.map.each_run(block.slot, block.slot + 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t n = first; n < last; ++n)
        if (field.nodes[n].mass > 0)
          block.work += exchange.ownership(static_cast<std::int64_t>(n)) * power(block.field, n, field.nodes[n]);
    });
  });
  OrderlessSums<1> sum;
  for (const Block& block : blocks_)
    if (system_.fields[block.field].map.is_own(block.slot)) sum.add(block.work);
  ledger_.nodal_work += dt * sum.total()[0];
}

template <int Dim>
void NodalWork<Dim>::keep_start(bool strain_filtered) {
  has_start_ = true;
  for (auto& field : system_.fields) {
    field.start_velocities.resize(field.nodes.size());
    parallel_for(static_cast<std::ptrdiff_t>(field.map.active().size()), [&](std::ptrdiff_t b) {
      const auto block = static_cast<std::size_t>(b);
      field.map.each_run(block, block + 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
          field.start_velocities[n] =
              Eigen::Map<const Vec3>(strain_filtered ? field.filter[n].velocity : field.nodes[n].velocity);
      });
    });
  }
}

template <int Dim>
void NodalWork<Dim>::record(double dt, bool filtered) {
  if (has_start_) {
    has_start_ = false;
    return add(dt, [&](std::size_t f, std::size_t n, const Node& node) {
      const Vec3 both = system_.fields[f].start_velocities[n] + Eigen::Map<const Vec3>(node.velocity);
      return 0.5 * node.mass * both.template head<Dim>().dot(Eigen::Map<const Vec<Dim>>(node.acceleration));
    });
  }
  const double since_middle = filtered ? 0.0 : 0.5 * dt;
  add(dt, [&](std::size_t, std::size_t, const Node& node) {
    double power = 0.0;
    for (int d = 0; d < Dim; ++d)
      power += node.acceleration[d] * (node.velocity[d] - since_middle * node.acceleration[d]);
    return node.mass * power;
  });
}

template <int Dim>
void NodalWork<Dim>::record_start(double dt, bool filtered) {
  forces_.resize(system_.fields.size());
  for (std::size_t f = 0; f < forces_.size(); ++f) forces_[f].resize(system_.fields[f].nodes.size());
  add(dt, [&](std::size_t f, std::size_t n, const Node& node) {
    forces_[f][n] = node.mass * Eigen::Map<const Vec3>(node.acceleration);
    if (has_start_)
      return 0.5 * forces_[f][n].template head<Dim>().dot(system_.fields[f].start_velocities[n].template head<Dim>());
    if (filtered) return 0.0;
    double power = 0.0;
    for (int d = 0; d < Dim; ++d) power += node.acceleration[d] * (node.velocity[d] - dt * node.acceleration[d]);
    return 0.5 * node.mass * power;
  });
}

template <int Dim>
void NodalWork<Dim>::record_end(double dt, bool filtered, bool strain_filtered) {
  const double share = filtered && !has_start_ ? 1.0 : 0.5;
  has_start_ = false;
  add(dt, [&](std::size_t f, std::size_t n, const Node& node) {
    const double* velocity = strain_filtered ? system_.fields[f].filter[n].velocity : node.velocity;
    return share * forces_[f][n].template head<Dim>().dot(Eigen::Map<const Vec<Dim>>(velocity));
  });
}

template <int Dim>
void NodalWork<Dim>::record_change_of_velocities(double dt) {
  OrderlessSums<1> all;
  for (auto& body : system_.bodies) {
    const double* mass = body.particles.mass();
    const auto ranges = body.bins.sum_ranges(body.particles.size(), pieces_);
    by_range_.assign(ranges.size(), 0.0);
    parallel_for(static_cast<std::ptrdiff_t>(ranges.size()), [&](std::ptrdiff_t k) {
      const Bin& range = ranges[static_cast<std::size_t>(k)];
      double sum = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double* change = body.particles[body.filtered][d];
#pragma omp simd reduction(+ : sum)
        for (std::uint32_t i = range.begin; i < range.end; ++i) sum += mass[i] * change[i];
      }
      by_range_[static_cast<std::size_t>(k)] = sum;
    });
    for (const double sum : by_range_) all.add(sum);
  }
  ledger_.nodal_work -= 0.5 * dt * all.total()[0];
}

template class NodalWork<2>;
template class NodalWork<3>;

}  // namespace tribo
