// SPDX-License-Identifier: MIT
#include "solver/boundary/nodal_conditions.hpp"

namespace tribo {
template <int Dim>
NodalConditions<Dim>::NodalConditions(const Model& model, const Lattice<Dim>& lattice)
    : NodalConditions(model, lattice, Problems()) {}

template <int Dim>
NodalConditions<Dim>::NodalConditions(const Model& model, const Lattice<Dim>& lattice, Problems problems)
    : model_(model),
      lattice_(lattice),
      selected_(std::make_shared<const SelectedNodes<Dim>>(model, lattice, problems)),
      walls_(model, lattice, problems),
      reactions_(model.node_conditions.size(), Vec3::Zero()) {
  problems.raise();
}

template <int Dim>
void NodalConditions<Dim>::locate(const BlockMap<Dim>& map) {
  thread_local std::vector<typename SelectedNodes<Dim>::Existing> existing;
  selected_->find(map, existing);
  located_.clear();
  for (const auto& [number, position] : existing)
    located_.push_back({position, number, map.is_own(static_cast<std::size_t>(position / block_nodes<Dim>))});
  walls_.locate(map);
}

template <int Dim>
double NodalConditions<Dim>::prescribed(const SelectedNode<Dim>& selected, const Vec<Dim>& x, double time,
                                        double dt) const {
  Vec3 at = Vec3::Zero();
  at.head<Dim>() = x;
  double sum = 0.0;
  for (const auto c : selected.conditions) sum += model_.node_conditions[c].velocity.at(time, at, dt);
  return sum;
}

template <int Dim>
void NodalConditions<Dim>::impose(NodeLayer& nodes, double time, double dt) {
  walls_.find(nodes, time);
  for (Located& l : located_) {
    const SelectedNode<Dim>& selected = (*selected_)[l.selected];
    Node& node = nodes[static_cast<std::size_t>(l.node)];
    l.pending = 0.0;
    if (!(node.mass > 0) || walls_.governs(l.node, selected.direction)) continue;
    Eigen::Map<Vec<Dim>> v(node.velocity);
    const double change = prescribed(selected, lattice_.position(selected.node), time, dt) - v.dot(selected.direction);
    v += change * selected.direction;
    l.pending = change;
  }
  walls_.impose(nodes, time, dt);
}

template <int Dim>
void NodalConditions<Dim>::impose_update(NodeLayer& nodes, const Exchange<Dim>& exchange, double time, double dt,
                                         bool after_impose, bool first, double replaced) {
  if (reactions_.empty()) return;
  sums_.start(3 * reactions_.size() + 4);
  walls_.find(nodes, time);
  for (Located& l : located_) {
    const SelectedNode<Dim>& selected = (*selected_)[l.selected];
    Node& node = nodes[static_cast<std::size_t>(l.node)];
    if (!(node.mass > 0) || walls_.governs(l.node, selected.direction)) continue;
    Eigen::Map<Vec<Dim>> v(node.velocity), a(node.acceleration);
    const Vec<Dim> x = lattice_.position(selected.node);
    const double wanted = prescribed(selected, x, time + dt, dt), before = prescribed(selected, x, time, dt);
    const double now = v.dot(selected.direction), free = a.dot(selected.direction);
    // The velocity at the start; contact may have taken back what it changed after impose().
    const double transferred = now - dt * free - (after_impose ? l.pending : 0.0);
    const double start = first ? transferred : before;
    const double correction = (wanted - start) / dt - free;
    v += (wanted - now) * selected.direction;
    a += correction * selected.direction;

    if (!l.own) continue;
    Vec3 along = Vec3::Zero();
    along.head<Dim>() = selected.direction;
    const double mass = exchange.ownership(l.node) * node.mass, force = mass * correction;
    for (const auto c : selected.conditions)
      book_reaction(c, force / static_cast<double>(selected.conditions.size()) * along);
    // force times mid-step velocity
    sums_.add(3 * reactions_.size() + 3, force * (wanted - 0.5 * dt * a.dot(selected.direction)));
    book_impulse(replaced * mass * (start - transferred) * along);
  }
  walls_.impose_update(nodes, exchange, time + dt, dt, after_impose, [&](const auto& on_node) {
    const Vec3 force = on_node.mass * on_node.acceleration * model_.node_conditions[on_node.condition].direction;
    book_reaction(on_node.condition, force);
    sums_.add(3 * reactions_.size() + 3, on_node.mass * on_node.acceleration * on_node.speed);
  });
  add_booked(dt);
}

template <int Dim>
void NodalConditions<Dim>::book_reaction(std::size_t condition, const Vec3& force) {
  for (std::size_t d = 0; d < Dim; ++d) sums_.add(3 * condition + d, force[static_cast<Eigen::Index>(d)]);
}

template <int Dim>
void NodalConditions<Dim>::book_impulse(const Vec3& impulse) {
  book_reaction(reactions_.size(), impulse);
}

template <int Dim>
void NodalConditions<Dim>::add_booked(double dt) {
  sums_.finish();
  const auto sum = [&](std::size_t k) { return Vec3(sums_[3 * k], sums_[3 * k + 1], sums_[3 * k + 2]); };
  for (std::size_t c = 0; c < reactions_.size(); ++c) reactions_[c] = sum(c), impulse_ += dt * reactions_[c];
  impulse_ += sum(reactions_.size());
  work_ += dt * sums_[3 * reactions_.size() + 3];
}

template <int Dim>
void NodalConditions<Dim>::release(AlignedVector<FilterNode>& nodes) const {
  for (const Located& l : located_) {
    const auto& direction = (*selected_)[l.selected].direction;
    Eigen::Map<Vec<Dim>> v(nodes[static_cast<std::size_t>(l.node)].increment);
    v -= v.dot(direction) * direction;
  }
  walls_.release(nodes);
}

template <int Dim>
void NodalConditions<Dim>::release(AlignedVector<FilterNode>& nodes, const Exchange<Dim>& exchange) {
  if (reactions_.empty()) return;
  OrderlessSums<Dim> taken;
  for (const Located& l : located_) {
    if (!l.own) continue;
    const FilterNode& node = nodes[static_cast<std::size_t>(l.node)];
    const auto& direction = (*selected_)[l.selected].direction;
    const double removed = Eigen::Map<const Vec<Dim>>(node.increment).dot(direction);
    taken.add(exchange.ownership(l.node) * node.mass * removed * direction);
  }
  impulse_.head<Dim>() -= taken.total();
  release(nodes);
}

template class NodalConditions<2>;
template class NodalConditions<3>;

}  // namespace tribo
