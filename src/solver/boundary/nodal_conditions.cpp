// SPDX-License-Identifier: MIT
#include "solver/boundary/nodal_conditions.hpp"

#include "grid/select.hpp"

#include <algorithm>
#include <map>

namespace tribo {
template <int Dim>
NodalConditions<Dim>::NodalConditions(const Model& model, const Lattice<Dim>& lattice)
    : NodalConditions(model, lattice, Problems()) {}

template <int Dim>
NodalConditions<Dim>::NodalConditions(const Model& model, const Lattice<Dim>& lattice, Problems problems)
    : model_(model),
      lattice_(lattice),
      walls_(model, lattice, problems),
      reactions_(model.node_conditions.size(), Vec3::Zero()) {
  // Whether a node belongs to the grid of the model or to the layer of nodes around it
  const auto near_grid = [&](const Index<Dim>& node) {
    for (std::size_t d = 0; d < Dim; ++d)
      if (const int n = node[d] - Lattice<Dim>::padding; n < -1 || n > model.grid.cells[d] + 1) return false;
    return true;
  };
  // Conditions on the same node in the same direction add.
  std::map<std::pair<std::int64_t, std::array<double, 3>>, std::size_t> known;
  for (std::size_t c = 0; c < model.node_conditions.size(); ++c) {
    const auto& condition = model.node_conditions[c];
    if (condition.wall) continue;
    bool any = false;
    each_node_in<Dim>(lattice, *condition.where, [&](const Index<Dim>& node) {
      any = any || near_grid(node);
      std::int64_t flat = 0;
      for (std::size_t d = Dim; d-- > 0;) flat = flat * lattice.blocks[d] * block_edge<Dim> + node[d];
      const auto& n = condition.direction;
      const auto [entry, fresh] = known.try_emplace({flat, {n[0], n[1], n[2]}}, chosen_.size());
      if (fresh) chosen_.push_back({node, n.template head<Dim>(), {}});
      chosen_[entry->second].conditions.push_back(c);
    });
    if (!any) problems.add(condition.origin, "this condition selects no node of the grid");
  }
  problems.raise();
}

template <int Dim>
void NodalConditions<Dim>::locate(const BlockMap<Dim>& map) {
  located_.clear();
  for (std::size_t c = 0; c < chosen_.size(); ++c) {
    const auto node = map.node(chosen_[c].node);
    if (node >= 0) located_.push_back({node, c});
  }
  walls_.locate(map);
}

template <int Dim>
double NodalConditions<Dim>::prescribed(const Chosen& chosen, const Vec<Dim>& x, double time, double dt) const {
  Vec3 at = Vec3::Zero();
  at.head<Dim>() = x;
  double sum = 0.0;
  for (const auto c : chosen.conditions) sum += model_.node_conditions[c].velocity.at(time, at, dt);
  return sum;
}

template <int Dim>
void NodalConditions<Dim>::impose(NodeLayer& nodes, double time, double dt) {
  walls_.find(nodes, time);
  for (Located& l : located_) {
    const Chosen& chosen = chosen_[l.chosen];
    Node& node = nodes[static_cast<std::size_t>(l.node)];
    l.pending = 0.0;
    if (!(node.mass > 0) || walls_.governs(l.node, chosen.direction)) continue;
    Eigen::Map<Vec<Dim>> v(node.velocity);
    const double change = prescribed(chosen, lattice_.position(chosen.node), time, dt) - v.dot(chosen.direction);
    v += change * chosen.direction;
    l.pending = change;
  }
  walls_.impose(nodes, time, dt);
}

template <int Dim>
void NodalConditions<Dim>::impose_update(NodeLayer& nodes, const Exchange<Dim>& exchange, double time, double dt,
                                         bool after_impose, bool first, double replaced) {
  for (auto& r : reactions_) r.setZero();
  walls_.find(nodes, time);
  for (Located& l : located_) {
    const Chosen& chosen = chosen_[l.chosen];
    Node& node = nodes[static_cast<std::size_t>(l.node)];
    if (!(node.mass > 0) || walls_.governs(l.node, chosen.direction)) continue;
    Eigen::Map<Vec<Dim>> v(node.velocity), a(node.acceleration);
    const Vec<Dim> x = lattice_.position(chosen.node);
    const double wanted = prescribed(chosen, x, time + dt, dt), before = prescribed(chosen, x, time, dt);
    const double now = v.dot(chosen.direction), free = a.dot(chosen.direction);
    // The velocity at the start; contact may have taken back what it changed after impose().
    const double transferred = now - dt * free - (after_impose ? l.pending : 0.0);
    const double start = first ? transferred : before;
    const double correction = (wanted - start) / dt - free;
    v += (wanted - now) * chosen.direction;
    a += correction * chosen.direction;

    Vec3 force = Vec3::Zero();
    const double mass = exchange.ownership(l.node) * node.mass;
    force.head<Dim>() = mass * correction * chosen.direction;
    for (const auto c : chosen.conditions) reactions_[c] += force / static_cast<double>(chosen.conditions.size());
    // force times mid-step velocity
    work_ += dt * mass * correction * (wanted - 0.5 * dt * a.dot(chosen.direction));
    impulse_ += dt * force;
    impulse_.head<Dim>() += replaced * mass * (start - transferred) * chosen.direction;
  }
  walls_.impose_update(nodes, exchange, time + dt, dt, after_impose, [&](const auto& on_node) {
    const Vec3 force = on_node.mass * on_node.acceleration * model_.node_conditions[on_node.condition].direction;
    reactions_[on_node.condition] += force;
    work_ += dt * on_node.mass * on_node.acceleration * on_node.speed;
    impulse_ += dt * force;
  });
}

template <int Dim>
void NodalConditions<Dim>::release(AlignedVector<FilterNode>& nodes) const {
  for (const Located& l : located_) {
    const auto& direction = chosen_[l.chosen].direction;
    Eigen::Map<Vec<Dim>> v(nodes[static_cast<std::size_t>(l.node)].increment);
    v -= v.dot(direction) * direction;
  }
  walls_.release(nodes);
}

template <int Dim>
void NodalConditions<Dim>::release(AlignedVector<FilterNode>& nodes, const Exchange<Dim>& exchange) {
  for (const Located& l : located_) {
    const FilterNode& node = nodes[static_cast<std::size_t>(l.node)];
    const auto& direction = chosen_[l.chosen].direction;
    const double removed = Eigen::Map<const Vec<Dim>>(node.increment).dot(direction);
    impulse_.head<Dim>() -= exchange.ownership(l.node) * node.mass * removed * direction;
  }
  release(nodes);
}

template class NodalConditions<2>;
template class NodalConditions<3>;

}  // namespace tribo
