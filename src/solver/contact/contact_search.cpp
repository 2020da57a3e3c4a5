// SPDX-License-Identifier: MIT
#include "solver/contact/contact_search.hpp"

#include <algorithm>
#include <map>

namespace tribo {

template <int Dim>
void ContactSearch<Dim>::locate() {
  shared_at_.resize(static_cast<std::size_t>(system_.lattice.block_count()), -1);
  for (const auto& s : shared_) shared_at_[static_cast<std::size_t>(s.block)] = -1;
  shared_.clear();
  std::map<std::int64_t, std::vector<std::pair<std::size_t, int>>> users;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& map = system_.fields[f].map;
    for (std::size_t slot = 0; slot < map.active().size(); ++slot)
      users[map.active()[slot]].emplace_back(f, static_cast<int>(slot));
  }
  for (auto& [block, slots] : users) {
    if (slots.size() < 2) continue;
    shared_at_[static_cast<std::size_t>(block)] = static_cast<int>(shared_.size());
    shared_.push_back({block, std::move(slots)});
  }
  node_of_.assign(shared_.size() * block_nodes<Dim>, -1);
  found_.clear();
}

template <int Dim>
void ContactSearch<Dim>::find(const Exchanges<Dim>& exchanges) {
  std::fill(node_of_.begin(), node_of_.end(), -1);
  found_.clear();
  next_kept_ = 0;
  for (std::size_t s = 0; s < shared_.size(); ++s) {
    const SharedBlock& shared = shared_[s];
    for (int local = 0; local < block_nodes<Dim>; ++local) {
      ContactNode<Dim> node{};
      if (!list_members(shared, local, node)) continue;
      const auto& [field, slot] = shared.slots[0];
      node.index = system_.fields[field].map.node_at(static_cast<std::int64_t>(slot) * block_nodes<Dim> + local);
      node.number = static_cast<std::int64_t>(s) * block_nodes<Dim> + local;
      const ContactMember& first = found_.members[node.first_member];
      node.mirrored_axes = exchanges[first.field]->mirrored_axes(node.index);
      node.ownership = exchanges[first.field]->ownership(first.node);
      list_pairs(node, place_of(node.number));
      node_of_[s * block_nodes<Dim> + static_cast<std::size_t>(local)] = static_cast<int>(found_.nodes.size());
      found_.nodes.push_back(node);
    }
  }
}

// Lists the fields with mass at a node of a shared block. False, and nothing is listed, if there are fewer than two or
// if all of them are rigid.
template <int Dim>
bool ContactSearch<Dim>::list_members(const SharedBlock& shared, int local, ContactNode<Dim>& node) {
  auto& members = found_.members;
  node.first_member = members.size();
  bool deformable = false;
  for (const auto& [f, slot] : shared.slots) {
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

// Two fields on the same side of all cracks follow the law of their materials. The law of two fields on the two sides
// of one crack is that of the crack.
template <int Dim>
void ContactSearch<Dim>::list_pairs(ContactNode<Dim>& node, std::int64_t place) {
  constexpr int two_cracks = 3;  // both bits of Field::side differ
  node.first_pair = found_.pairs.size();
  for (std::size_t a = node.first_member; a < node.end_member; ++a)
    for (std::size_t b = a + 1; b < node.end_member; ++b) {
      const ContactMember &of_a = found_.members[a], &of_b = found_.members[b];
      const Field<Dim>&field_a = system_.fields[of_a.field], &field_b = system_.fields[of_b.field];
      const int between = field_a.side ^ field_b.side;
      if (of_a.inverse_mass + of_b.inverse_mass == 0.0 || between == two_cracks) continue;
      ContactPair pair;
      pair.a = a, pair.b = b;
      pair.state.mass = 1.0 / (of_a.inverse_mass + of_b.inverse_mass);
      if (between == 0)
        pair.law = laws_.between(field_a.base_field, field_b.base_field), node.between_bodies = true;
      else
        pair.crack = 0;
      const KeptPair self{place, static_cast<std::int64_t>(of_a.field), static_cast<std::int64_t>(of_b.field), false,
                          Vec3::Zero()};
      while (next_kept_ < kept_.size() && kept_[next_kept_].precedes(self)) ++next_kept_;
      if (next_kept_ < kept_.size() && !self.precedes(kept_[next_kept_]))
        pair.stuck = kept_[next_kept_].stuck, pair.update_impulse = kept_[next_kept_].impulse;
      found_.pairs.push_back(pair);
    }
  node.end_pair = found_.pairs.size();
}

template <int Dim>
std::int64_t ContactSearch<Dim>::place_of(std::int64_t number) const {
  return shared_[static_cast<std::size_t>(number / block_nodes<Dim>)].block * block_nodes<Dim> +
         number % block_nodes<Dim>;
}

// Without friction a pair without tangential motion has the status stick, too, but no tangential impulse.
template <int Dim>
void ContactSearch<Dim>::remember_pairs() {
  constexpr double round_off = 1e-12;
  kept_.clear();
  for (const ContactNode<Dim>& node : found_.nodes)
    for (ContactPair& pair : found_.pairs_of(node)) {
      const Vec3 &impulse = pair.update_impulse, &n = pair.state.normal;
      pair.stuck = pair.update_status == ContactStatus::stick &&
                   (impulse - impulse.dot(n) * n).norm() > round_off * impulse.norm();
      if (!pair.stuck && impulse.isZero(0)) continue;
      const auto field = [&](std::size_t member) { return static_cast<std::int64_t>(found_.members[member].field); };
      kept_.push_back({place_of(node.number), field(pair.a), field(pair.b), pair.stuck, impulse});
    }
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
