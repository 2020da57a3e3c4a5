// SPDX-License-Identifier: MIT
#include "solver/loads/nodal_work.hpp"

#include "base/parallel.hpp"

namespace tribo {

// Sums power(field, number, node) over the nodes, block by block, so that the sum does not depend on the number of
// threads.
template <int Dim>
template <class F>
void NodalWork<Dim>::add(double dt, F&& power) {
  double sum = 0.0;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& field = system_.fields[f];
    if (field.rigid_contact) continue;
    by_block_.assign(field.map.active().size(), 0.0);
    parallel_for(static_cast<std::ptrdiff_t>(by_block_.size()), [&](std::ptrdiff_t block) {
      double work = 0.0;
      for (std::int64_t n = block * block_nodes<Dim>; n < (block + 1) * block_nodes<Dim>; ++n) {
        const Node& node = field.nodes[static_cast<std::size_t>(n)];
        if (!(node.mass > 0)) continue;
        work += exchanges_[f]->ownership(n) * power(f, static_cast<std::size_t>(n), node);
      }
      by_block_[static_cast<std::size_t>(block)] = work;
    });
    for (const double work : by_block_) sum += work;
  }
  ledger_.nodal_work += dt * sum;
}

template <int Dim>
void NodalWork<Dim>::record(double dt) {
  add(dt, [&](std::size_t, std::size_t, const Node& node) {
    double power = 0.0;
    for (int d = 0; d < Dim; ++d) power += node.acceleration[d] * (node.velocity[d] - 0.5 * dt * node.acceleration[d]);
    return node.mass * power;
  });
}

template <int Dim>
void NodalWork<Dim>::record_start(double dt) {
  forces_.resize(system_.fields.size());
  for (std::size_t f = 0; f < forces_.size(); ++f) forces_[f].resize(system_.fields[f].nodes.size());
  add(dt, [&](std::size_t f, std::size_t n, const Node& node) {
    forces_[f][n] = node.mass * Eigen::Map<const Vec3>(node.acceleration);
    double power = 0.0;
    for (int d = 0; d < Dim; ++d) power += node.acceleration[d] * (node.velocity[d] - dt * node.acceleration[d]);
    return 0.5 * node.mass * power;
  });
}

template <int Dim>
void NodalWork<Dim>::record_end(double dt, bool filtered) {
  add(dt, [&](std::size_t f, std::size_t n, const Node& node) {
    const double* velocity = filtered ? system_.fields[f].filter[n].velocity : node.velocity;
    return 0.5 * forces_[f][n].template head<Dim>().dot(Eigen::Map<const Vec<Dim>>(velocity));
  });
}

template class NodalWork<2>;
template class NodalWork<3>;

}  // namespace tribo
