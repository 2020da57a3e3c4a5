// SPDX-License-Identifier: MIT
#include "solver/contact/contact_search.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>

namespace tribo {

template <int Dim>
void ContactSearch<Dim>::locate() {
  shared_at_.resize(static_cast<std::size_t>(system_.lattice.block_count()), -1);
  for (const auto& s : shared_) shared_at_[static_cast<std::size_t>(s.block)] = -1;
  shared_.clear();
  std::map<std::int64_t, std::vector<BlockUser>> all;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& map = system_.fields[f].map;
    for (std::size_t slot = 0; slot < map.active().size(); ++slot)
      all[map.active()[slot]].push_back({f, static_cast<int>(slot), map.reached(slot)});
  }
  for (auto& [block, users] : all) {
    std::uint64_t once = 0, twice = 0;
    for (const BlockUser& user : users) twice |= once & user.reached, once |= user.reached;
    if (twice == 0) continue;
    shared_at_[static_cast<std::size_t>(block)] = static_cast<int>(shared_.size());
    shared_.push_back({block, twice, std::move(users)});
  }
  node_of_.assign(shared_.size() * block_nodes<Dim>, -1);
  found_.clear();
}

// In parallel by chunks of shared blocks: first the nodes and their members, then, with the place of the pairs of each
// chunk among all pairs, the pairs. The lists do not depend on the number of threads.
template <int Dim>
void ContactSearch<Dim>::find(const Exchanges<Dim>& exchanges) {
  std::fill(node_of_.begin(), node_of_.end(), -1);
  chunks_.resize((shared_.size() + chunk_blocks - 1) / chunk_blocks);
  const auto count = static_cast<std::ptrdiff_t>(chunks_.size());
  parallel_for(count, [&](std::ptrdiff_t k) { list_nodes(exchanges, static_cast<std::size_t>(k)); });
  std::size_t nodes = 0, members = 0, pairs = 0;
  for (Chunk& chunk : chunks_) {
    chunk.first_node = nodes, chunk.first_member = members, chunk.first_pair = pairs;
    nodes += chunk.nodes.size(), members += chunk.members.size(), pairs += chunk.pair_count;
  }
  // All elements are assigned below, so those of the last step need not be removed first.
  found_.nodes.resize(nodes), found_.members.resize(members), found_.pairs.resize(pairs);
  parallel_for(count, [&](std::ptrdiff_t k) {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(k)];
    std::copy(chunk.members.begin(), chunk.members.end(),
              found_.members.begin() + static_cast<std::ptrdiff_t>(chunk.first_member));
    std::size_t pair = chunk.first_pair;
    for (std::size_t n = 0; n < chunk.nodes.size(); ++n) {
      ContactNode<Dim>& node = found_.nodes[chunk.first_node + n] = chunk.nodes[n];
      node.first_member += chunk.first_member, node.end_member += chunk.first_member;
      node.first_pair = pair;
      list_pairs(node, place_of(node.number));
      pair = node.end_pair;
      node_of_[static_cast<std::size_t>(node.number)] = static_cast<int>(chunk.first_node + n);
    }
  });
}

// Lists the contact nodes of the blocks of a chunk, with their members, and counts their pairs.
template <int Dim>
void ContactSearch<Dim>::list_nodes(const Exchanges<Dim>& exchanges, std::size_t number) {
  Chunk& chunk = chunks_[number];
  chunk.nodes.clear(), chunk.members.clear(), chunk.pair_count = 0;
  const std::size_t first = number * chunk_blocks;
  for (std::size_t s = first; s < std::min(first + chunk_blocks, shared_.size()); ++s) {
    const SharedBlock& shared = shared_[s];
    for (std::uint64_t rest = shared.nodes; rest != 0; rest &= rest - 1) {
      const int local = std::countr_zero(rest);
      ContactNode<Dim> node{};
      if (!list_members(shared, local, node, chunk.members)) continue;
      const BlockUser& user = shared.users[0];
      node.index =
          system_.fields[user.field].map.node_at(static_cast<std::int64_t>(user.slot) * block_nodes<Dim> + local);
      node.number = static_cast<std::int64_t>(s) * block_nodes<Dim> + local;
      const ContactMember& of_first = chunk.members[node.first_member];
      node.mirrored_axes = exchanges[of_first.field]->mirrored_axes(node.index);
      node.ownership = exchanges[of_first.field]->ownership(of_first.node);
      for (std::size_t a = node.first_member; a < node.end_member; ++a)
        for (std::size_t b = a + 1; b < node.end_member; ++b)
          chunk.pair_count += can_touch(chunk.members[a], chunk.members[b]) ? 1 : 0;
      chunk.nodes.push_back(node);
    }
  }
}

// Lists the fields with mass at a node of a shared block. False, and nothing is listed, if there are fewer than two or
// if all of them are rigid.
template <int Dim>
bool ContactSearch<Dim>::list_members(const SharedBlock& shared, int local, ContactNode<Dim>& node,
                                      std::vector<ContactMember>& members) const {
  node.first_member = members.size();
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
  node.end_member = members.size();
  if (node.end_member - node.first_member >= 2 && deformable) return true;
  members.resize(node.first_member);
  return false;
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
void ContactSearch<Dim>::list_pairs(ContactNode<Dim>& node, std::int64_t place) {
  std::size_t next = node.first_pair;
  auto kept = std::lower_bound(kept_.begin(), kept_.end(), place,
                               [](const KeptPair& pair, std::int64_t at) { return pair.place < at; });
  for (std::size_t a = node.first_member; a < node.end_member; ++a)
    for (std::size_t b = a + 1; b < node.end_member; ++b) {
      const ContactMember &of_a = found_.members[a], &of_b = found_.members[b];
      const Field<Dim>&field_a = system_.fields[of_a.field], &field_b = system_.fields[of_b.field];
      const int between = field_a.side ^ field_b.side;
      if (!can_touch(of_a, of_b)) continue;
      ContactPair& pair = found_.pairs[next++];
      pair = {};
      pair.a = a, pair.b = b;
      pair.state.mass = 1.0 / (of_a.inverse_mass + of_b.inverse_mass);
      if (between == 0)
        pair.law = laws_.between(field_a.base_field, field_b.base_field), node.between_bodies = true;
      else
        pair.crack = 0;
      const KeptPair self{place,
                          static_cast<std::int64_t>(of_a.field),
                          static_cast<std::int64_t>(of_b.field),
                          ContactStatus::open,
                          Vec3::Zero(),
                          Vec3::Zero(),
                          0.0};
      while (kept != kept_.end() && kept->precedes(self)) ++kept;
      if (kept != kept_.end() && !self.precedes(*kept))
        pair.update_status = kept->status, pair.update_impulse = kept->impulse, pair.end_velocity = kept->velocity,
        pair.update_mass = kept->mass;
    }
  node.end_pair = next;
}

template <int Dim>
std::int64_t ContactSearch<Dim>::place_of(std::int64_t number) const {
  return shared_[static_cast<std::size_t>(number / block_nodes<Dim>)].block * block_nodes<Dim> +
         number % block_nodes<Dim>;
}

// In parallel by ranges of nodes: first the number of pairs with an impulse, then these pairs.
template <int Dim>
void ContactSearch<Dim>::remember_pairs() {
  constexpr std::size_t length = 256;  // of a range
  const std::size_t count = (found_.nodes.size() + length - 1) / length;
  kept_before_.assign(count + 1, 0);
  const auto each_kept = [&](std::ptrdiff_t range, auto&& f) {
    const std::size_t first = length * static_cast<std::size_t>(range);
    for (std::size_t n = first; n < std::min(first + length, found_.nodes.size()); ++n)
      for (const ContactPair& pair : found_.active_pairs_of(found_.nodes[n]))
        if (!pair.update_impulse.isZero(0)) f(found_.nodes[n], pair);
  };
  parallel_for(static_cast<std::ptrdiff_t>(count), [&](std::ptrdiff_t range) {
    std::size_t& pairs = kept_before_[static_cast<std::size_t>(range) + 1];
    each_kept(range, [&](const auto&, const auto&) { ++pairs; });
  });
  std::partial_sum(kept_before_.begin(), kept_before_.end(), kept_before_.begin());
  kept_.resize(kept_before_.back());
  parallel_for(static_cast<std::ptrdiff_t>(count), [&](std::ptrdiff_t range) {
    std::size_t next = kept_before_[static_cast<std::size_t>(range)];
    each_kept(range, [&](const ContactNode<Dim>& node, const ContactPair& pair) {
      const auto field = [&](std::size_t member) { return static_cast<std::int64_t>(found_.members[member].field); };
      kept_[next++] = {place_of(node.number), field(pair.a),     field(pair.b),   pair.update_status,
                       pair.update_impulse,   pair.end_velocity, pair.update_mass};
    });
  });
}

template <int Dim>
const ContactNode<Dim>* ContactSearch<Dim>::node_at(const Index<Dim>& index) const {
  Index<Dim> block;
  std::size_t local = 0;
  bool inside = true;
  for (std::size_t d = Dim; d-- > 0;) {
    inside = inside && index[d] >= 0 && index[d] < system_.lattice.blocks[d] * block_edge<Dim>;
    block[d] = index[d] / block_edge<Dim>;
    local = local * block_edge<Dim> + static_cast<std::size_t>(index[d] % block_edge<Dim>);
  }
  if (!inside || shared_at_.empty()) return nullptr;
  const int s = shared_at_[static_cast<std::size_t>(system_.lattice.block_index(block))];
  if (s < 0) return nullptr;
  const int n = node_of_[static_cast<std::size_t>(s) * block_nodes<Dim> + local];
  return n < 0 ? nullptr : &found_.nodes[static_cast<std::size_t>(n)];
}

template class ContactSearch<2>;
template class ContactSearch<3>;

}  // namespace tribo
