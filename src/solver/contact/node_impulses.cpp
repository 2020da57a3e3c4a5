// SPDX-License-Identifier: MIT
#include "solver/contact/node_impulses.hpp"

#include "base/parallel.hpp"
#include "solver/contact/node_solver.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
void NodeImpulses<Dim>::apply(double dt, ContactPass pass) {
  auto& nodes = contacts_.nodes;
  auto& members = contacts_.members;
  auto& pairs = contacts_.pairs;
  parallel_for(static_cast<std::ptrdiff_t>(nodes.size()), [&](std::ptrdiff_t k) {
    const ContactNode<Dim>& node = nodes[static_cast<std::size_t>(k)];
    if (node.idle || node.solved_on_faces) return;
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      ContactMember& m = members[i];
      const Node& at = system_.fields[m.field].nodes[static_cast<std::size_t>(m.node)];
      m.trial_velocity = Eigen::Map<const Vec3>(at.velocity);
      m.start_velocity = m.trial_velocity;
      if (pass == ContactPass::corrector) m.start_velocity -= dt * Eigen::Map<const Vec3>(at.acceleration);
    }
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) pairs[p].state.dt = dt;
    const auto of_node = contacts_.pairs_of(node);
    solve_node(members, of_node, pass, false);
    if (pass == ContactPass::corrector)
      for (ContactPair& pair : of_node) pair.applied = pair.impulse;
    if (std::none_of(of_node.begin(), of_node.end(), [](const ContactPair& pair) { return pair.has_impulse(); }))
      return;
    if (pass != ContactPass::corrector) {
      for (ContactPair& pair : of_node) pair.at_start = pair.impulse;
      return change_at_start(node, 1.0);
    }
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p)
      for (const auto& [i, sign] : {std::pair{pairs[p].a, 1.0}, std::pair{pairs[p].b, -1.0}}) {
        Node& at = system_.fields[members[i].field].nodes[static_cast<std::size_t>(members[i].node)];
        const Vec3 change = sign * members[i].inverse_mass * pairs[p].impulse;
        Eigen::Map<Vec3>(at.velocity) += change;
        Eigen::Map<Vec3>(at.acceleration) += change / dt;
      }
  });
}

template <int Dim>
void NodeImpulses<Dim>::change_at_start(const ContactNode<Dim>& node, double sign) {
  for (const ContactPair& pair : contacts_.pairs_of(node))
    for (const auto& [i, side] : {std::pair{pair.a, sign}, std::pair{pair.b, -sign}}) {
      const ContactMember& m = contacts_.members[i];
      Node& at = system_.fields[m.field].nodes[static_cast<std::size_t>(m.node)];
      Eigen::Map<Vec3>(at.velocity) += side * m.inverse_mass * pair.at_start;
    }
}

template <int Dim>
void NodeImpulses<Dim>::remove() {
  parallel_for(static_cast<std::ptrdiff_t>(contacts_.nodes.size()), [&](std::ptrdiff_t k) {
    const ContactNode<Dim>& node = contacts_.nodes[static_cast<std::size_t>(k)];
    if (!node.idle && !node.solved_on_faces) change_at_start(node, -1.0);
  });
}

template <int Dim>
void NodeImpulses<Dim>::constrain_increments(ContactPass pass) {
  auto& nodes = contacts_.nodes;
  auto& members = contacts_.members;
  parallel_for(static_cast<std::ptrdiff_t>(nodes.size()), [&](std::ptrdiff_t k) {
    const ContactNode<Dim>& node = nodes[static_cast<std::size_t>(k)];
    if (node.idle || node.solved_on_faces) return;
    const auto pairs = contacts_.pairs_of(node);
    const auto increment = [&](const ContactMember& m) {
      return Eigen::Map<Vec3>(system_.fields[m.field].filter[static_cast<std::size_t>(m.node)].increment);
    };
    // The increment becomes the velocity after contact with it minus the velocity after contact without it.
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      ContactMember& m = members[i];
      if (m.inverse_mass == 0.0) continue;
      const Vec3 before = velocity_after(members, pairs, i);
      m.trial_velocity += increment(m);
      increment(m) = -before;
    }
    solve_node(members, pairs, pass, true);
    for (std::size_t i = node.first_member; i < node.end_member; ++i)
      if (members[i].inverse_mass > 0.0) increment(members[i]) += velocity_after(members, pairs, i);
  });
}

template class NodeImpulses<2>;
template class NodeImpulses<3>;

}  // namespace tribo
