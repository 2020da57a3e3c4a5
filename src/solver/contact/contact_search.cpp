// SPDX-License-Identifier: MIT
#include "solver/contact/contact_search.hpp"

#include "base/common_data.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <bit>
#include <map>

namespace tribo {

template <int Dim>
void ContactSearch<Dim>::locate() {
  if (!is_new_) kept_ = kept_pairs(), share_kept_pairs();
  is_new_ = true;
  shared_.clear();
  std::map<std::int64_t, std::vector<BlockUser>> all;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& map = system_.fields[f].map;
    for (std::size_t slot = 0; slot < map.active().size(); ++slot)
      all[map.active()[slot]].push_back({f, static_cast<int>(slot), map.reached(slot) & map.complete(slot)});
  }
  for (auto& [block, users] : all) {
    std::uint64_t once = 0, twice = 0;
    for (const BlockUser& user : users) twice |= once & user.reached, once |= user.reached;
    if (twice == 0) continue;
    const bool own = system_.fields[users[0].field].map.is_own(static_cast<std::size_t>(users[0].slot));
    shared_.push_back({block, twice, own, std::move(users)});
  }
  BlockBox<Dim> box;
  for (const SharedBlock& shared : shared_) box.include(system_.lattice.block_at(shared.block));
  shared_at_.reset(box);
  for (std::size_t s = 0; s < shared_.size(); ++s)
    shared_at_.at(system_.lattice.block_at(shared_[s].block)) = static_cast<int>(s);
  found_.clear();
}

// Calls f(block, local number of the node, its number) for the nodes of a part that the particles of two or more fields
// can reach, until f returns false. False if it did.
template <int Dim>
template <class F>
bool ContactSearch<Dim>::each_shared_node(std::size_t part, F&& f) const {
  const std::size_t first = part * part_blocks, end = std::min(first + part_blocks, shared_.size());
  for (std::size_t s = first; s < end; ++s)
    for (std::uint64_t rest = shared_[s].nodes; rest != 0; rest &= rest - 1) {
      const int local = std::countr_zero(rest);
      if (!f(shared_[s], local, shared_[s].block * block_nodes<Dim> + local)) return false;
    }
  return true;
}

// In parallel by parts: most parts have the nodes and members of the last step and only take their present masses. The
// others are listed anew. The lists do not depend on the number of threads.
template <int Dim>
void ContactSearch<Dim>::find(const Exchanges<Dim>& exchanges) {
  auto& parts = found_.parts;
  if (is_new_) parts.assign((shared_.size() + part_blocks - 1) / part_blocks, {});
  fresh_.resize(parts.size());
  const auto count = static_cast<std::ptrdiff_t>(parts.size());
  const auto list = [&](std::ptrdiff_t k) { list_nodes(exchanges, static_cast<std::size_t>(k)); };
  parallel_for(count, [&](std::ptrdiff_t k) {
    ContactPart& part = parts[static_cast<std::size_t>(k)];
    part.changed = is_new_ || !update_part(static_cast<std::size_t>(k));
    if (part.changed) list(k);
  });
  found_.moved = false;
  if (std::any_of(parts.begin(), parts.end(), [](const ContactPart& part) { return part.changed; })) {
    if (!place_parts()) {
      parallel_for(count, [&](std::ptrdiff_t k) {
        ContactPart& part = parts[static_cast<std::size_t>(k)];
        if (!part.changed) part.changed = true, list(k);
      });
      place_parts();
    }
    place_nodes();
    parallel_for(count, [&](std::ptrdiff_t k) { fill_part(static_cast<std::size_t>(k)); });
    found_.nodes.swap(next_);
  }
  if (is_new_) std::vector<Fresh>().swap(fresh_);  // later only few parts change
  is_new_ = false;
}

// Gives the members of a part their present masses, and begins a new step for its pairs. False if the nodes or members
// are others than in the last step.
template <int Dim>
bool ContactSearch<Dim>::update_part(std::size_t number) {
  const ContactPart& part = found_.parts[number];
  thread_local std::vector<ContactMember> present;
  std::size_t n = part.first_node;
  const bool same = each_shared_node(number, [&](const SharedBlock& shared, int local, std::int64_t place) {
    present.clear();
    if (!list_members(shared, local, present)) return true;
    if (n == part.end_node) return false;
    const ContactNode<Dim>& node = found_.nodes[n++];
    if (node.number != place || node.end_member - node.first_member != present.size()) return false;
    for (std::size_t k = 0; k < present.size(); ++k) {
      ContactMember& member = found_.members[node.first_member + k];
      if (member.field != present[k].field) return false;
      member.mass = present[k].mass, member.inverse_mass = present[k].inverse_mass;
    }
    for (ContactPair& pair : found_.pairs_of(node)) {
      if (!node.idle) renew_pair(pair);
      pair.state.mass = 1.0 / (found_.members[pair.a].inverse_mass + found_.members[pair.b].inverse_mass);
    }
    return true;
  });
  return same && n == part.end_node;
}

// Keeps of a pair who it is, and if an impulse acted in the last update, what is known of that.
template <int Dim>
void ContactSearch<Dim>::renew_pair(ContactPair& pair) const {
  ContactPair next;
  next.a = pair.a, next.b = pair.b;
  if (pair.crack < 0)
    next.law = pair.law;
  else
    next.crack = 0;
  if (!pair.update_impulse.isZero(0)) {
    next.update_impulse = pair.update_impulse, next.update_status = pair.update_status;
    next.end_velocity = pair.end_velocity, next.update_mass = pair.update_mass;
  }
  pair = next;
}

// Lists the contact nodes of a part with their members, counts their pairs, and collects what is kept of those which
// the part had before.
template <int Dim>
void ContactSearch<Dim>::list_nodes(const Exchanges<Dim>& exchanges, std::size_t number) {
  Fresh& fresh = fresh_[number];
  fresh.nodes.clear(), fresh.members.clear(), fresh.kept.clear(), fresh.pair_count = 0;
  const ContactPart& part = found_.parts[number];
  add_kept(std::span(found_.nodes).subspan(part.first_node, part.end_node - part.first_node), fresh.kept);
  each_shared_node(number, [&](const SharedBlock& shared, int local, std::int64_t place) {
    ContactNode<Dim> node{};
    node.first_member = fresh.members.size();
    if (!list_members(shared, local, fresh.members)) return true;
    node.end_member = fresh.members.size();
    const BlockUser& user = shared.users[0];
    node.index =
        system_.fields[user.field].map.node_at(static_cast<std::int64_t>(user.slot) * block_nodes<Dim> + local);
    node.number = place, node.own = shared.own;
    const ContactMember& of_first = fresh.members[node.first_member];
    node.mirrored_axes = exchanges[of_first.field]->mirrored_axes(node.index);
    node.ownership = exchanges[of_first.field]->ownership(of_first.node);
    node.first_pair = fresh.pair_count;
    for (std::size_t a = node.first_member; a < node.end_member; ++a)
      for (std::size_t b = a + 1; b < node.end_member; ++b)
        fresh.pair_count += can_touch(fresh.members[a], fresh.members[b]) ? 1 : 0;
    node.end_pair = fresh.pair_count;
    fresh.nodes.push_back(node);
    return true;
  });
}

// Adds the fields with mass at a node of a shared block to the list. False, and nothing is added, if there are fewer
// than two or if all of them are rigid.
template <int Dim>
bool ContactSearch<Dim>::list_members(const SharedBlock& shared, int local, std::vector<ContactMember>& members) const {
  const std::size_t first = members.size();
  bool deformable = false;
  for (const auto& [f, slot, reached] : shared.users) {
    if ((reached >> local & 1) == 0) continue;
    const auto at = static_cast<std::int64_t>(slot) * block_nodes<Dim> + local;
    const double m = system_.fields[f].nodes[static_cast<std::size_t>(at)].mass;
    if (!(m > 0)) continue;
    const bool rigid = system_.fields[f].rigid_contact;
    deformable = deformable || !rigid;
    ContactMember member;
    member.field = f, member.node = at, member.mass = m, member.inverse_mass = rigid ? 0.0 : 1.0 / m;
    members.push_back(member);
  }
  if (members.size() - first >= 2 && deformable) return true;
  members.resize(first);
  return false;
}

// Gives the parts that have changed places for their members and pairs. If all have changed, they get new rooms; false
// if some do not fit into the rooms that they have.
template <int Dim>
bool ContactSearch<Dim>::place_parts() {
  constexpr std::size_t more = 4;  // room for an eighth, and at least this, more
  const auto room = [&](std::size_t size) { return size + size / 8 + more; };
  auto& parts = found_.parts;
  const bool anew = std::all_of(parts.begin(), parts.end(), [](const ContactPart& part) { return part.changed; });
  std::size_t members = 0, pairs = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    ContactPart& part = parts[k];
    const std::size_t member_count = fresh_[k].members.size(), pair_count = fresh_[k].pair_count;
    if (anew) {
      part.first_member = members, part.member_room = room(member_count), members += part.member_room;
      part.first_pair = pairs, part.pair_room = room(pair_count), pairs += part.pair_room;
    }
    if (!part.changed) continue;
    if (member_count > part.member_room || pair_count > part.pair_room) return false;
    part.end_member = part.first_member + member_count, part.end_pair = part.first_pair + pair_count;
  }
  if (anew) found_.members.resize(members), found_.pairs.resize(pairs), found_.moved = true;
  return true;
}

// Gives all nodes their places in the new list, and copies those of parts that have not changed.
template <int Dim>
void ContactSearch<Dim>::place_nodes() {
  auto& parts = found_.parts;
  std::size_t count = 0;
  for (std::size_t k = 0; k < parts.size(); ++k)
    count += parts[k].changed ? fresh_[k].nodes.size() : parts[k].end_node - parts[k].first_node;
  next_.resize(count);
  std::size_t first = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    ContactPart& part = parts[k];
    const std::span<const ContactNode<Dim>> kept(found_.nodes);
    const auto nodes = part.changed ? std::span<const ContactNode<Dim>>(fresh_[k].nodes)
                                    : kept.subspan(part.first_node, part.end_node - part.first_node);
    std::copy(nodes.begin(), nodes.end(), next_.begin() + static_cast<std::ptrdiff_t>(first));
    part.first_node = first, part.end_node = first += nodes.size();
  }
}

// Fills the places of a part that has changed.
template <int Dim>
void ContactSearch<Dim>::fill_part(std::size_t number) {
  const ContactPart& part = found_.parts[number];
  if (!part.changed) return;
  const Fresh& fresh = fresh_[number];
  std::copy(fresh.members.begin(), fresh.members.end(),
            found_.members.begin() + static_cast<std::ptrdiff_t>(part.first_member));
  for (std::size_t n = part.first_node; n < part.end_node; ++n) {
    ContactNode<Dim>& node = next_[n];
    node.first_member += part.first_member, node.end_member += part.first_member;
    node.first_pair += part.first_pair, node.end_pair += part.first_pair;
    list_pairs(node, is_new_ ? std::span<const KeptPair>(kept_) : std::span<const KeptPair>(fresh.kept));
  }
}

// Two fields that differ by the sides of two cracks do not touch, nor do two rigid ones.
template <int Dim>
bool ContactSearch<Dim>::can_touch(const ContactMember& a, const ContactMember& b) const {
  constexpr int two_cracks = 3;  // both bits of Field::side differ
  return a.inverse_mass + b.inverse_mass != 0.0 &&
         (system_.fields[a.field].side ^ system_.fields[b.field].side) != two_cracks;
}

// Two fields on the same side of all cracks follow the law of their materials. The law of two fields on the two sides
// of one crack is that of the crack.
template <int Dim>
void ContactSearch<Dim>::list_pairs(ContactNode<Dim>& node, std::span<const KeptPair> kept) {
  ContactPair* next = &found_.pairs[node.first_pair];
  auto last = std::lower_bound(kept.begin(), kept.end(), node.number,
                               [](const KeptPair& pair, std::int64_t at) { return pair.place < at; });
  for (std::size_t a = node.first_member; a < node.end_member; ++a)
    for (std::size_t b = a + 1; b < node.end_member; ++b) {
      const ContactMember &of_a = found_.members[a], &of_b = found_.members[b];
      const Field<Dim>&field_a = system_.fields[of_a.field], &field_b = system_.fields[of_b.field];
      const int between = field_a.side ^ field_b.side;
      if (!can_touch(of_a, of_b)) continue;
      ContactPair& pair = *next++;
      pair = {};
      pair.a = a, pair.b = b;
      pair.state.mass = 1.0 / (of_a.inverse_mass + of_b.inverse_mass);
      if (between == 0)
        pair.law = laws_.between(field_a.base_field, field_b.base_field), node.between_bodies = true;
      else
        pair.crack = 0;
      const KeptPair self = kept_pair(node, pair);
      while (last != kept.end() && last->precedes(self)) ++last;
      if (last != kept.end() && !self.precedes(*last))
        pair.update_status = last->status, pair.update_impulse = last->impulse, pair.end_velocity = last->velocity,
        pair.update_mass = last->mass;
    }
}

template <int Dim>
auto ContactSearch<Dim>::kept_pair(const ContactNode<Dim>& node, const ContactPair& pair) const -> KeptPair {
  const auto field = [&](std::size_t member) { return static_cast<std::int64_t>(found_.members[member].field); };
  return {node.number,         field(pair.a),     field(pair.b),   pair.update_status,
          pair.update_impulse, pair.end_velocity, pair.update_mass};
}

// Adds the pairs of some nodes with an impulse in the last momentum update to a list.
template <int Dim>
template <class Nodes>
void ContactSearch<Dim>::add_kept(const Nodes& nodes, std::vector<KeptPair>& to) const {
  for (const ContactNode<Dim>& node : nodes)
    for (const ContactPair& pair : found_.pairs_of(node))
      if (!pair.update_impulse.isZero(0)) to.push_back(kept_pair(node, pair));
}

template <int Dim>
auto ContactSearch<Dim>::kept_pairs() const -> std::vector<KeptPair> {
  std::vector<KeptPair> kept;
  if (ranks().count() == 1) {
    add_kept(found_.nodes, kept);
  } else {
    for (const ContactNode<Dim>& node : found_.nodes)
      if (node.own) add_kept(std::span(&node, 1), kept);
  }
  return kept;
}

template <int Dim>
void ContactSearch<Dim>::archive_kept(Archive& a, std::vector<KeptPair>& kept) {
  std::vector<std::int64_t> numbers;
  std::vector<double> impulses, velocities, masses;
  for (const KeptPair& pair : kept) {
    numbers.insert(numbers.end(), {pair.place, pair.a, pair.b, static_cast<std::int64_t>(pair.status)});
    impulses.insert(impulses.end(), pair.impulse.begin(), pair.impulse.end());
    velocities.insert(velocities.end(), pair.velocity.begin(), pair.velocity.end());
    masses.push_back(pair.mass);
  }
  a.resizable("pairs", numbers), a.resizable("impulses", impulses), a.resizable("velocities", velocities);
  a.resizable("masses", masses);
  kept.resize(numbers.size() / 4);
  if (numbers.size() != 4 * kept.size() || impulses.size() != 3 * kept.size() || velocities.size() != impulses.size() ||
      masses.size() != kept.size())
    refuse_checkpoint("the pairs of contact and their impulses differ in number");
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::int64_t* n = numbers.data() + 4 * k;
    kept[k] = {n[0],
               n[1],
               n[2],
               static_cast<ContactStatus>(n[3]),
               Eigen::Map<const Vec3>(impulses.data() + 3 * k),
               Eigen::Map<const Vec3>(velocities.data() + 3 * k),
               masses[k]};
  }
}

// In a run of several processes, every one receives the pairs at the own nodes of all others, which kept_ has before.
template <int Dim>
void ContactSearch<Dim>::share_kept_pairs() {
  if (ranks().count() == 1) return;
  ByteWriter own;
  for (const KeptPair& pair : kept_) {
    own.value(pair.place), own.value(pair.a), own.value(pair.b), own.value(pair.status), own.value(pair.mass);
    for (const Vec3* vector : {&pair.impulse, &pair.velocity})
      for (const double component : *vector) own.value(component);
  }
  const auto all = values_of_all_ranks(own.data);
  kept_.clear();
  for (ByteReader reader(all); !reader.at_end();) {
    KeptPair pair;
    pair.place = reader.value<std::int64_t>(), pair.a = reader.value<std::int64_t>();
    pair.b = reader.value<std::int64_t>(), pair.status = reader.value<ContactStatus>();
    pair.mass = reader.value<double>();
    for (Vec3* vector : {&pair.impulse, &pair.velocity})
      for (double& component : *vector) component = reader.value<double>();
    kept_.push_back(pair);
  }
  std::ranges::sort(kept_, [](const KeptPair& one, const KeptPair& other) { return one.precedes(other); });
}

template <int Dim>
const ContactNode<Dim>* ContactSearch<Dim>::node_at(const Index<Dim>& index) const {
  Index<Dim> block;
  std::size_t local = 0;
  for (std::size_t d = Dim; d-- > 0;) {
    if (index[d] < 0) return nullptr;
    block[d] = index[d] / block_edge<Dim>;
    local = local * block_edge<Dim> + static_cast<std::size_t>(index[d] % block_edge<Dim>);
  }
  const int s = shared_at_[block];
  if (s < 0 || found_.parts.empty()) return nullptr;
  const auto number = system_.lattice.block_index(block) * block_nodes<Dim> + static_cast<std::int64_t>(local);
  const ContactPart& part = found_.parts[static_cast<std::size_t>(s) / part_blocks];
  const auto nodes = std::span(found_.nodes).subspan(part.first_node, part.end_node - part.first_node);
  const auto node = std::ranges::lower_bound(nodes, number, {}, &ContactNode<Dim>::number);
  return node == nodes.end() || node->number != number ? nullptr : &*node;
}

template class ContactSearch<2>;
template class ContactSearch<3>;

}  // namespace tribo
