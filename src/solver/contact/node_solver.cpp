// SPDX-License-Identifier: MIT
#include "solver/contact/node_solver.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace tribo {
namespace {

constexpr int max_passes = 100;
// Of the impulses, relative. Their error is that of the last change times r / (1 - r) with the rate of convergence r.
// It is far below that of the interpolation between particles and nodes, and the tolerance far above round-off.
constexpr double tolerance = 1e-13;
// Where faces stick and slip in turn, the iteration does not converge: the changes no longer decrease. It ends when
// this many passes have not made the smallest change half as large.
constexpr int patience = 10;
// Changes that decrease by the same rate from pass to pass are summed up to their limit. Rates beyond the largest would
// extrapolate too far; where the rate is small the passes suffice.
constexpr double least_rate = 0.05, largest_rate = 0.98;

// Change of the impulses in a pass, and what it is to be compared with.
struct Change {
  double change = 0.0, size = 0.0;
  bool is_small() const { return change <= tolerance * tolerance * size; }
};

// A pair on which an impulse may act, what its faces keep, its impulse before the present iteration, and the changes in
// the last two iterations.
struct ActivePair {
  ContactPair* pair;
  Hold hold;
  Vec3 old = Vec3::Zero(), change = Vec3::Zero(), before = Vec3::Zero();
};

void add_impulse(std::span<ContactMember> members, ContactPair& pair, const Vec3& impulse) {
  ContactMember &a = members[pair.a], &b = members[pair.b];
  pair.impulse += impulse;
  a.velocity += a.inverse_mass * impulse, b.velocity -= b.inverse_mass * impulse;
}

// The law reads the relative velocity without the impulse of its own pair.
void solve_pair(std::span<ContactMember> members, const ActivePair& active) {
  ContactPair& pair = *active.pair;
  ContactState& m = pair.state;
  ContactMember &a = members[pair.a], &b = members[pair.b];
  m.velocity = b.velocity - a.velocity + (a.inverse_mass + b.inverse_mass) * pair.impulse;
  pair.response = response_of(pair, m, active.hold);
  const Vec3 change = pair.response.impulse - pair.impulse;
  pair.impulse = pair.response.impulse;
  a.velocity += a.inverse_mass * change, b.velocity -= b.inverse_mass * change;
}

// All pairs, forward and backward.
Change pass_over(std::span<ContactMember> members, std::span<ActivePair> pairs) {
  for (ActivePair& p : pairs) p.old = p.pair->impulse, solve_pair(members, p);
  for (std::size_t k = pairs.size() - 1; k-- > 0;) solve_pair(members, pairs[k]);
  Change all;
  for (ActivePair& p : pairs) {
    const ContactState& m = p.pair->state;
    p.before = p.change, p.change = p.pair->impulse - p.old;
    all.change += p.change.squaredNorm();
    all.size += p.pair->impulse.squaredNorm() + p.old.squaredNorm() + m.mass * m.mass * m.velocity.squaredNorm();
  }
  return all;
}

// Aitken's extrapolation of all impulses from the last two passes; false if the changes do not decrease steadily. The
// passes that follow bring the impulses back into the limits of their laws.
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
  for (const ActivePair& p : pairs) {
    for (const std::size_t i : {p.pair->a, p.pair->b}) members[i].velocity = members[i].trial_velocity - common;
    p.pair->state.start = members[p.pair->b].start_velocity - members[p.pair->a].start_velocity;
  }
  for (const ActivePair& p : pairs) {
    ContactMember &a = members[p.pair->a], &b = members[p.pair->b];
    a.velocity += a.inverse_mass * p.pair->impulse, b.velocity -= b.inverse_mass * p.pair->impulse;
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
    if (pair.may_touch()) active.push_back({&pair, hold_of(pair, pass)});
  }
  if (active.empty()) return;
  begin_velocities(members, active);
  if (active.size() == 1) {
    solve_pair(members, active[0]);
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  int waited = 0, steady = 0;  // passes since the change decreased, and since the last extrapolation
  for (int k = 0; k < max_passes; ++k) {
    const Change change = pass_over(members, active);
    if (change.is_small()) break;
    if (change.change < 0.25 * least)
      least = change.change, waited = 0;
    else if (++waited == patience)
      break;
    if (++steady >= 2 && k + 1 < max_passes && extrapolate(members, active)) steady = 0;
  }
}

}  // namespace tribo
