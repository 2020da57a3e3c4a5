// SPDX-License-Identifier: MIT
#include "solver/contact/contact_ledger.hpp"

#include "base/bytes.hpp"
#include "base/ranks.hpp"
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

// Rank 0 of a run in several processes adds all entries in the order of the nodes, as a single process does.
template <int Dim>
void ContactLedger<Dim>::book(Sum sum, const Key& pair, const Vec3& value) {
  const Entry entry{node_->number, sum, {pair.first, pair.second}, {value[0], value[1], value[2]}};
  if (ranks().count() == 1) return add(entry);
  if (node_->own) entries_.push_back(entry);
}

template <int Dim>
void ContactLedger<Dim>::add(const Entry& entry) {
  const Eigen::Map<const Vec3> value(entry.value.data());
  switch (entry.sum) {
    case Sum::nodal_work:
      nodal_work += value[0];
      return;
    case Sum::rigid_work:
      rigid_work += value[0];
      return;
    case Sum::rigid_impulse:
      rigid_impulse += value;
      return;
    default:
      break;
  }
  const Key key{entry.pair[0], entry.pair[1]};
  if (!last_ || last_key_ != key) last_ = &pairs[key], last_key_ = key;
  switch (entry.sum) {
    case Sum::force:
      last_->force += value;
      return;
    case Sum::area:
      last_->area += value[0];
      return;
    case Sum::friction:
      last_->friction += value[0];
      return;
    case Sum::impact:
      last_->impact += value[0];
      return;
    default:
      last_->interface += value[0];
  }
}

template <int Dim>
void ContactLedger<Dim>::add_booked() {
  if (ranks().count() == 1) return;
  ByteWriter mine;
  mine.values(std::span<const Entry>(entries_));
  entries_.clear();
  for (const auto& message : ranks().gather(std::move(mine.data))) {
    const std::size_t before = entries_.size();
    entries_.resize(before + message.size() / sizeof(Entry));
    ByteReader(message).values(std::span<Entry>(entries_).subspan(before));
  }
  std::ranges::stable_sort(entries_, {}, &Entry::node);
  for (const Entry& entry : entries_) add(entry);
  entries_.clear();
}

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

// Relative velocity of a pair, at a node from the present velocities of the nodes or of the filter. `rigid`: with the
// velocities of rigid members, otherwise they count as zero.
template <int Dim>
Vec3 ContactLedger<Dim>::velocity_of(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node,
                                     const ContactPair& pair, bool rigid, bool strain_filtered) const {
  if (node.solved_on_faces) return rigid ? pair.final_velocity : Vec3(pair.final_velocity - pair.rigid_velocity);
  Vec3 velocity = Vec3::Zero();
  for (const auto& [member, sign] : {std::pair{pair.a, -1.0}, std::pair{pair.b, 1.0}}) {
    const ContactMember& m = contacts.members[member];
    const bool is_rigid = m.inverse_mass == 0.0;
    if (is_rigid && !rigid) continue;
    const auto& field = system_.fields[m.field];
    const auto n = static_cast<std::size_t>(m.node);
    const bool filtered = strain_filtered && !is_rigid;
    velocity += sign * Eigen::Map<const Vec3>(filtered ? field.filter[n].velocity : field.nodes[n].velocity);
  }
  return velocity;
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
void ContactLedger<Dim>::add_work(const ContactNode<Dim>& node, ContactPair& pair, const Key& of, double all,
                                  double normal) {
  if (pair.law->interface()) return book(Sum::interface, of, all);
  book(Sum::impact, of, normal), book(Sum::friction, of, all - normal);
  pair.friction_work += (all - normal) / node.ownership;
}

template <int Dim>
void ContactLedger<Dim>::keep_start(ContactNodes<Dim>& contacts, bool strain_filtered) {
  has_start_ = true;
  for (const auto& node : contacts.nodes)
    for (ContactPair& pair : contacts.active_pairs_of(node))
      pair.strain_velocity = velocity_of(contacts, node, pair, true, strain_filtered);
}

template <int Dim>
void ContactLedger<Dim>::record(ContactNodes<Dim>& contacts, double dt, bool replaces, bool filtered, double kept) {
  for (auto& [fields, entry] : pairs) entry.force.setZero(), entry.stored = entry.area = 0.0;
  rigid_exchanges_.assign(system_.fields.size(), {});
  for (const auto& node : contacts.nodes) {
    if (node.idle) continue;
    begin_node(node);
    if (replaces && !filtered && !has_start_) book(Sum::nodal_work, node.ownership * extrapolated(contacts, node, dt));
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      ContactPair& pair = contacts.pairs[p];
      pair.update_impulse = pair.impulse, pair.update_mass = pair.state.mass;
      pair.update_status = pair.response.status;
      pair.total_impulse.setZero(), pair.friction_work = 0.0;
      if (!pair.law) continue;  // a joint acts in its place
      if (pair.response.status == ContactStatus::open && !pair.has_impulse()) continue;
      Relative v = relative(contacts, node, pair, dt);
      pair.update_velocity = velocity_of(contacts, node, pair, false, false);
      pair.end_velocity = v.end;
      if (has_start_) v.start = pair.strain_velocity;
      const bool at_end = !has_start_ && (replaces || filtered);
      const Vec3 mean = at_end ? v.end : Vec3(0.5 * (v.start + v.end));
      // The impulse at the start removes a relative velocity that the extrapolation has made: its work is that at the
      // velocity which remains, and the rest a loss of the transfer.
      const Part parts[] = {{pair.impulse, mean}, {kept * pair.at_start, v.start}};
      const Vec3 impulse = parts[0].impulse + parts[1].impulse, beyond = impulse - pair.applied;
      pair.total_impulse = impulse;
      book(Sum::nodal_work, node.ownership * (pair.applied.dot(mean) - parts[0].work() - parts[1].work()));
      if (pair.response.status == ContactStatus::open && impulse.isZero(0)) continue;
      const Key of = key(contacts, pair);
      book(Sum::force, of, Vec3(node.ownership / dt * impulse));
      book(Sum::area, of, node.ownership * pair.state.area);
      for (const Part& part : parts) {
        const double all = node.ownership * part.work();
        const double normal = node.ownership * part.along(pair.state.normal).work();
        add_work(node, pair, of, all, normal);
      }
      record_rigid(contacts, node, pair, impulse, beyond);
    }
  }
  add_booked();
}

template <int Dim>
void ContactLedger<Dim>::record_end(ContactNodes<Dim>& contacts, bool filtered, bool strain_filtered) {
  const double share = filtered && !has_start_ ? 1.0 : 0.5;  // of the work that is done at the velocities at the end
  for (const auto& node : contacts.nodes) {
    begin_node(node);
    for (ContactPair& pair : contacts.active_pairs_of(node)) {
      if (!pair.law || (pair.update_impulse.isZero(0) && pair.applied.isZero(0))) continue;
      const Vec3 change = velocity_of(contacts, node, pair, false, strain_filtered) - pair.update_velocity;
      const Vec3 along_normal = change.dot(pair.state.normal) * pair.state.normal, along_face = change - along_normal;
      // The friction of faces that slide is in equilibrium with the stress next to them, so that its work is that at
      // the velocities which strain the bodies.
      const bool slides = pair.update_status == ContactStatus::slip;
      const Vec3 mean_change = share * along_normal + (slides ? 1.0 : share) * along_face;
      const Part part{node.ownership * pair.update_impulse, mean_change};
      book(Sum::nodal_work, node.ownership * (pair.applied - pair.update_impulse).dot(mean_change));
      add_work(node, pair, key(contacts, pair), part.work(), part.along(pair.state.normal).work());
    }
  }
  add_booked();
}

template <int Dim>
void ContactLedger<Dim>::record_block_motion(ContactNodes<Dim>& contacts, const std::vector<BlockMean>& means) {
  for (const auto& node : contacts.nodes) {
    begin_node(node);
    for (ContactPair& pair : contacts.active_pairs_of(node)) {
      if (!pair.law || pair.total_impulse.isZero(0)) continue;
      for (const auto& [side, sign] : {std::pair{pair.a, -1.0}, std::pair{pair.b, 1.0}}) {
        const ContactMember& rigid = contacts.members[side];
        const auto k = system_.fields[rigid.field].block;
        if (rigid.inverse_mass > 0.0 || k < 0) continue;
        const RigidPoint at = rigid_point(node, pair, rigid, sign);
        const BlockMean& mean = means[static_cast<std::size_t>(k)];
        const Part part{node.ownership * pair.total_impulse,
                        sign * (mean.v + mean.w.cross(at.x - mean.x) - at.velocity)};
        book(Sum::rigid_work, part.work());
        add_work(node, pair, key(contacts, pair), part.work(), part.along(pair.state.normal).work());
      }
    }
  }
  add_booked();
}

template <int Dim>
void ContactLedger<Dim>::add_inertia(const ContactPair& pair, double mass, const Vec3& r, RigidExchange& to) {
  const bool slides = pair.response.status == ContactStatus::slip && !pair.law->interface() && pair.law->liquid() == 0;
  const Mat3 held = slides ? Mat3(pair.state.normal * pair.state.normal.transpose()) : Mat3(Mat3::Identity());
  Eigen::Matrix<double, 3, 6> velocity;  // at the node, for unit velocities and rotations
  velocity << 1, 0, 0, 0, r[2], -r[1], 0, 1, 0, -r[2], 0, r[0], 0, 0, 1, r[1], -r[0], 0;
  to.inertia += mass * velocity.transpose() * held * velocity;
}

// An impulse of a node acts at the node, one of a face at the face.
template <int Dim>
auto ContactLedger<Dim>::rigid_point(const ContactNode<Dim>& node, const ContactPair& pair, const ContactMember& rigid,
                                     double sign) const -> RigidPoint {
  Vec3 x = Vec3::Zero();
  x.head<Dim>() = system_.lattice.position(node.index);
  if (node.solved_on_faces)
    return {x + pair.face_position * pair.state.normal + pair.foremost_offset, sign * pair.rigid_velocity};
  return {x, Eigen::Map<const Vec3>(system_.fields[rigid.field].nodes[static_cast<std::size_t>(rigid.node)].velocity)};
}

// `total`: impulse on the first member of the pair; `beyond`: the part of it that is not in the accelerations of the
// nodes.
template <int Dim>
void ContactLedger<Dim>::record_rigid(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node,
                                      const ContactPair& pair, const Vec3& total, const Vec3& beyond) {
  for (const auto& [side, other, sign] : {std::tuple{pair.a, pair.b, -1.0}, std::tuple{pair.b, pair.a, 1.0}}) {
    const ContactMember& rigid = contacts.members[side];
    if (rigid.inverse_mass > 0.0) continue;
    const Vec3 impulse = sign * node.ownership * total;  // on the other field
    const auto [x, velocity] = rigid_point(node, pair, rigid, sign);
    book(Sum::rigid_work, impulse.dot(velocity));
    book(Sum::nodal_work, sign * node.ownership * beyond.dot(velocity));
    book(Sum::rigid_impulse, {}, impulse);
    RigidExchange& exchange = rigid_exchanges_[rigid.field];
    exchange.impulse -= impulse, exchange.moment -= x.cross(impulse);
    if (const auto k = system_.fields[rigid.field].block; k >= 0) {
      const auto block = static_cast<std::size_t>(k);
      exchange.moment_tensor -= impulse * system_.blocks->nearest_on(block, x).transpose();
      add_inertia(pair, node.ownership * contacts.members[other].mass, x - system_.blocks->motion[block].x, exchange);
    }
  }
}

template <int Dim>
void ContactLedger<Dim>::end_step(double dt) {
  time += dt, has_start_ = false;
  for (auto& [fields, entry] : pairs) entry.impulse += dt * entry.force;
}

template <int Dim>
void ContactLedger<Dim>::start_means() {
  time = 0.0;
  for (auto& [fields, entry] : pairs) entry.impulse.setZero();
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
