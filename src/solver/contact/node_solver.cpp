// SPDX-License-Identifier: MIT
#include "solver/contact/node_solver.hpp"

#include <limits>
#include <vector>

namespace tribo {
namespace {

constexpr int max_sweeps = 200;
// Of the impulses, relative. Their error is that of the last change times r / (1 - r) with the rate of convergence r,
// which is 0.5 to 0.9 at nodes of many bodies. It is far below that of the interpolation between particles and nodes,
// and the tolerance far above round-off.
constexpr double tolerance = 1e-13;
// Where faces stick and slip in turn, the iteration does not converge: the changes no longer decrease. It ends when
// this many sweeps have not made the smallest change half as large.
constexpr int patience = 30;

// Change of the impulses in a sweep, and what it is to be compared with.
struct Change {
  double change = 0.0, size = 0.0;
  void operator+=(const Change& other) { change += other.change, size += other.size; }
  bool is_small() const { return change <= tolerance * tolerance * size; }
};

// The law reads the relative velocity without the impulse of its own pair.
Change solve_pair(std::span<ContactMember> members, ContactPair& pair, ContactPass pass) {
  ContactState& m = pair.state;
  ContactMember &a = members[pair.a], &b = members[pair.b];
  m.velocity = b.velocity - a.velocity + pair.impulse / m.mass;
  m.start = b.start_velocity - a.start_velocity;
  pair.response = response_of(pair, m, pass);
  const Vec3 change = pair.response.impulse - pair.impulse;
  const double size =
      pair.response.impulse.squaredNorm() + pair.impulse.squaredNorm() + m.mass * m.mass * m.velocity.squaredNorm();
  pair.impulse = pair.response.impulse;
  a.velocity += a.inverse_mass * change, b.velocity -= b.inverse_mass * change;
  return {change.squaredNorm(), size};
}

// Velocities of the members after the present impulses, against one of them, which saves digits if all move fast.
void begin_velocities(std::span<ContactMember> members, std::span<ContactPair* const> pairs) {
  const Vec3 common = members[pairs[0]->a].trial_velocity;
  for (const ContactPair* pair : pairs)
    for (const std::size_t i : {pair->a, pair->b}) members[i].velocity = members[i].trial_velocity - common;
  for (const ContactPair* pair : pairs) {
    ContactMember &a = members[pair->a], &b = members[pair->b];
    a.velocity += a.inverse_mass * pair->impulse, b.velocity -= b.inverse_mass * pair->impulse;
  }
}

}  // namespace

Vec3 velocity_after(std::span<const ContactMember> members, std::span<const ContactPair> pairs, std::size_t member) {
  const ContactMember& m = members[member];
  Vec3 v = m.trial_velocity;
  for (const ContactPair& pair : pairs) {
    if (pair.a == member) v += m.inverse_mass * pair.impulse;
    if (pair.b == member) v -= m.inverse_mass * pair.impulse;
  }
  return v;
}

void solve_node(std::span<ContactMember> members, std::span<ContactPair> pairs, ContactPass pass, bool warm_start) {
  thread_local std::vector<ContactPair*> active;
  active.clear();
  for (ContactPair& pair : pairs) {
    if (!warm_start) pair.impulse.setZero(), pair.response = {};
    if (!pair.has_no_face && !pair.replaced_by_joint) active.push_back(&pair);
  }
  if (active.empty()) return;
  begin_velocities(members, active);
  if (active.size() == 1) {
    solve_pair(members, *active[0], pass);
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  int waited = 0;
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    Change change;
    for (std::size_t k = 0; k < active.size(); ++k)
      change += solve_pair(members, *active[sweep % 2 == 0 ? k : active.size() - 1 - k], pass);
    if (change.is_small()) break;
    if (change.change < 0.25 * least)
      least = change.change, waited = 0;
    else if (++waited == patience)
      break;
  }
}

}  // namespace tribo
