// SPDX-License-Identifier: MIT
#include "solver/contact/contact_ledger.hpp"

#include "blocks/assembly.hpp"

#include <algorithm>

namespace tribo {
namespace {

// An impulse, and the relative velocity at which it acts.
struct Part {
  Vec3 impulse, velocity;
  double work() const { return impulse.dot(velocity); }
  Part along(const Vec3& n) const { return {impulse.dot(n) * n, velocity}; }
};

}  // namespace

template <int Dim>
auto ContactLedger<Dim>::key(const ContactNodes<Dim>& contacts, const ContactPair& pair) const -> Key {
  const std::size_t field_count = system_.fields.size();
  if (pair.crack >= 0) return {field_count + static_cast<std::size_t>(pair.crack), field_count};
  return {system_.fields[contacts.members[pair.a].field].base_field,
          system_.fields[contacts.members[pair.b].field].base_field};
}

// At a node from its final velocities, which a filter may have changed after contact.
template <int Dim>
auto ContactLedger<Dim>::relative(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node,
                                  const ContactPair& pair, double dt) const -> Relative {
  if (node.solved_on_faces) return {pair.state.start, pair.final_velocity};
  const auto at = [&](std::size_t member) -> const Node& {
    const ContactMember& m = contacts.members[member];
    return system_.fields[m.field].nodes[static_cast<std::size_t>(m.node)];
  };
  const Node &a = at(pair.a), &b = at(pair.b);
  const Vec3 end = Eigen::Map<const Vec3>(b.velocity) - Eigen::Map<const Vec3>(a.velocity);
  return {end - dt * (Eigen::Map<const Vec3>(b.acceleration) - Eigen::Map<const Vec3>(a.acceleration)), end};
}

// Half the sum of m v^2 over the fields of a node that touch, v the change of their velocities in the step against that
// of their centre of mass.
template <int Dim>
double ContactLedger<Dim>::extrapolated(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node,
                                        double dt) const {
  const auto touching = contacts.pairs_of(node);
  if (std::all_of(touching.begin(), touching.end(), [](const ContactPair& pair) {
        return !pair.law || (pair.impulse.isZero(0) && pair.applied.isZero(0));
      }))
    return 0.0;
  double mass = 0.0, square = 0.0;
  bool rigid = false;
  Vec3 momentum = Vec3::Zero();
  for (std::size_t i = node.first_member; i < node.end_member; ++i) {
    const ContactMember& m = contacts.members[i];
    const Node& at = system_.fields[m.field].nodes[static_cast<std::size_t>(m.node)];
    const Vec3 change = dt * Eigen::Map<const Vec3>(at.acceleration);
    if (m.inverse_mass == 0.0)
      rigid = true;
    else
      mass += at.mass, momentum += at.mass * change, square += at.mass * change.squaredNorm();
  }
  return 0.5 * (rigid || !(mass > 0) ? square : square - momentum.squaredNorm() / mass);
}

template <int Dim>
void ContactLedger<Dim>::record(ContactNodes<Dim>& contacts, double dt, bool replaces, bool filtered, double kept) {
  for (auto& [fields, entry] : pairs) entry.force.setZero(), entry.stored = entry.area = 0.0;
  rigid_exchanges_.assign(system_.fields.size(), {});
  for (const auto& node : contacts.nodes) {
    if (replaces && !filtered) nodal_work += node.ownership * extrapolated(contacts, node, dt);
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      ContactPair& pair = contacts.pairs[p];
      pair.update_impulse = pair.impulse, pair.update_status = pair.response.status, pair.friction_work = 0.0;
      if (!pair.law) continue;  // a joint acts in its place
      const Relative v = relative(contacts, node, pair, dt);
      const Vec3 mean = replaces || filtered ? v.end : Vec3(0.5 * (v.start + v.end));
      // The impulse at the start removes a relative velocity that the extrapolation has made: its work is that at the
      // velocity which remains, and the rest a loss of the transfer.
      const Part parts[] = {{pair.impulse, mean}, {kept * pair.at_start, v.start}};
      const Vec3 impulse = parts[0].impulse + parts[1].impulse, beyond = impulse - pair.applied;
      nodal_work += node.ownership * (pair.applied.dot(mean) - parts[0].work() - parts[1].work());
      if (pair.response.status == ContactStatus::open && impulse.isZero(0)) continue;
      auto& entry = pairs[key(contacts, pair)];
      entry.force += node.ownership / dt * impulse;
      entry.area += node.ownership * pair.state.area;
      for (const Part& part : parts) {
        const double all = node.ownership * part.work();
        const double normal = node.ownership * part.along(pair.state.normal).work();
        if (pair.law->interface())
          entry.interface += all;
        else
          entry.impact += normal, entry.friction += all - normal, pair.friction_work += (all - normal) / node.ownership;
      }
      record_rigid(contacts, node, pair, impulse, beyond);
    }
  }
}

// An impulse of a node acts at the node, one of a face at the face. `total`: impulse on the first member of the pair;
// `beyond`: the part of it that is not in the accelerations of the nodes.
template <int Dim>
void ContactLedger<Dim>::record_rigid(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node,
                                      const ContactPair& pair, const Vec3& total, const Vec3& beyond) {
  for (const auto& [side, other, sign] : {std::tuple{pair.a, pair.b, -1.0}, std::tuple{pair.b, pair.a, 1.0}}) {
    const ContactMember& rigid = contacts.members[side];
    if (rigid.inverse_mass > 0.0) continue;
    const Node& at = system_.fields[rigid.field].nodes[static_cast<std::size_t>(rigid.node)];
    const Vec3 impulse = sign * node.ownership * total;  // on the other field
    const Vec3 velocity =
        node.solved_on_faces ? Vec3(sign * pair.rigid_velocity) : Vec3(Eigen::Map<const Vec3>(at.velocity));
    rigid_work += impulse.dot(velocity);
    nodal_work += sign * node.ownership * beyond.dot(velocity);
    rigid_impulse += impulse;
    Vec3 x = Vec3::Zero();
    x.head<Dim>() = system_.lattice.position(node.index);
    if (node.solved_on_faces) x += pair.face_position * pair.state.normal;
    RigidExchange& exchange = rigid_exchanges_[rigid.field];
    const double mass = node.ownership * contacts.members[other].mass;
    exchange.impulse -= impulse, exchange.moment -= x.cross(impulse);
    if (const auto k = system_.fields[rigid.field].block; k >= 0)
      exchange.moment_tensor -= impulse * system_.blocks->nearest_on(static_cast<std::size_t>(k), x).transpose();
    exchange.mass += mass, exchange.first_moment += mass * x, exchange.second_moment += mass * x.squaredNorm();
  }
}

template <int Dim>
PairLedger ContactLedger<Dim>::total() const {
  PairLedger sum;
  for (const auto& [fields, entry] : pairs) {
    sum.friction += entry.friction, sum.impact += entry.impact, sum.interface += entry.interface;
    sum.stored += entry.stored, sum.area += entry.area;
  }
  return sum;
}

template class ContactLedger<2>;
template class ContactLedger<3>;

}  // namespace tribo
