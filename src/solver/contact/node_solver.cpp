// SPDX-License-Identifier: MIT
#include "solver/contact/node_solver.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace tribo {
namespace {

constexpr int max_sweeps = 200;
// Of the impulses, relative. Their error is that of the last change times r / (1 - r) with the rate of convergence r,
// which is 0.5 to 0.9 at nodes of many bodies. It is far below that of the interpolation between particles and nodes,
// and the tolerance far above round-off.
constexpr double tolerance = 1e-12;
// Where faces stick and slip in turn, the iteration does not converge: the changes no longer decrease. It ends when
// this many sweeps have not made the smallest change half as large.
constexpr int patience = 10;
// Changes that decrease by the same rate from sweep to sweep are summed up to their limit. Rates beyond the largest
// would extrapolate too far; where the rate is small the sweeps suffice.
constexpr double least_rate = 0.05, largest_rate = 0.98;

// Change of the impulses in a sweep, and what it is to be compared with.
struct Change {
  double change = 0.0, size = 0.0;
  void operator+=(const Change& other) { change += other.change, size += other.size; }
  bool is_small() const { return change <= tolerance * tolerance * size; }
};

// A pair on which an impulse may act, and the changes of its impulse in the last two sweeps.
struct ActivePair {
  ContactPair* pair;
  Vec3 change = Vec3::Zero(), before = Vec3::Zero();
};

void add_impulse(std::span<ContactMember> members, ContactPair& pair, const Vec3& impulse) {
  ContactMember &a = members[pair.a], &b = members[pair.b];
  pair.impulse += impulse;
  a.velocity += a.inverse_mass * impulse, b.velocity -= b.inverse_mass * impulse;
}

// The law reads the relative velocity without the impulse of its own pair.
Change solve_pair(std::span<ContactMember> members, ActivePair& active, ContactPass pass) {
  ContactPair& pair = *active.pair;
  ContactState& m = pair.state;
  const ContactMember &a = members[pair.a], &b = members[pair.b];
  m.velocity = b.velocity - a.velocity + (a.inverse_mass + b.inverse_mass) * pair.impulse;
  pair.response = response_of(*pair.law, m, pair.stuck, pass);
  const Vec3 impulse = pair.response.impulse;
  const double size = impulse.squaredNorm() + pair.impulse.squaredNorm() + m.mass * m.mass * m.velocity.squaredNorm();
  active.before = active.change, active.change = impulse - pair.impulse;
  add_impulse(members, pair, active.change);
  pair.impulse = impulse;
  return {active.change.squaredNorm(), size};
}

// Aitken's extrapolation of all impulses from the last two sweeps; false if the changes do not decrease steadily. The
// sweeps that follow bring the impulses back into the limits of their laws.
bool extrapolate(std::span<ContactMember> members, std::span<const ActivePair> pairs) {
  double product = 0.0, square = 0.0;
  for (const ActivePair& p : pairs) product += p.change.dot(p.before), square += p.before.squaredNorm();
  if (!(product > least_rate * square)) return false;
  const double rate = std::min(product / square, largest_rate);
  for (const ActivePair& p : pairs) add_impulse(members, *p.pair, rate / (1.0 - rate) * p.change);
  return true;
}

// Velocities of the members after the present impulses, against one of them, which saves digits if all move fast.
void begin_velocities(std::span<ContactMember> members, std::span<const ActivePair> pairs) {
  const Vec3 common = members[pairs[0].pair->a].trial_velocity;
  for (const auto& [pair, change, before] : pairs) {
    for (const std::size_t i : {pair->a, pair->b}) members[i].velocity = members[i].trial_velocity - common;
    pair->state.start = members[pair->b].start_velocity - members[pair->a].start_velocity;
  }
  for (const auto& [pair, change, before] : pairs) {
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
  thread_local std::vector<ActivePair> active;
  active.clear();
  for (ContactPair& pair : pairs) {
    if (!warm_start) pair.impulse.setZero(), pair.response = {};
    if (!pair.has_no_face && !pair.replaced_by_joint) active.push_back({&pair});
  }
  if (active.empty()) return;
  begin_velocities(members, active);
  if (active.size() == 1) {
    solve_pair(members, active[0], pass);
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  int waited = 0, steady = 0;  // sweeps since the change decreased, and since the last extrapolation
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    Change change;
    for (ActivePair& pair : active) change += solve_pair(members, pair, pass);
    if (change.is_small()) break;
    if (change.change < 0.25 * least)
      least = change.change, waited = 0;
    else if (++waited == patience)
      break;
    if (++steady >= 2 && sweep + 1 < max_sweeps && extrapolate(members, active)) steady = 0;
  }
}

}  // namespace tribo
