// SPDX-License-Identifier: MIT
#include "solver/contact/node_solver.hpp"

namespace tribo {
namespace {

constexpr int max_sweeps = 200;
constexpr double tolerance = 1e-14;  // of the impulses, relative

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

void solve_node(std::span<const ContactMember> members, std::span<ContactPair> pairs, ContactPass pass,
                bool warm_start) {
  if (!warm_start)
    for (ContactPair& pair : pairs) pair.impulse.setZero(), pair.response = {};
  const std::size_t count = pairs.size();
  for (int sweep = 0; sweep < (count == 1 ? 1 : max_sweeps); ++sweep) {
    double change = 0.0, size = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      ContactPair& pair = pairs[sweep % 2 == 0 ? k : count - 1 - k];
      if (pair.has_no_face || pair.replaced_by_joint) continue;
      ContactState& m = pair.state;
      // The law reads the relative velocity without the impulse of its own pair.
      m.velocity =
          velocity_after(members, pairs, pair.b) - velocity_after(members, pairs, pair.a) + pair.impulse / m.mass;
      m.start = members[pair.b].start_velocity - members[pair.a].start_velocity;
      pair.response = response_of(pair, pass);
      change += (pair.response.impulse - pair.impulse).squaredNorm();
      size +=
          pair.response.impulse.squaredNorm() + pair.impulse.squaredNorm() + m.mass * m.mass * m.velocity.squaredNorm();
      pair.impulse = pair.response.impulse;
    }
    if (change <= tolerance * tolerance * size) break;
  }
}

}  // namespace tribo
