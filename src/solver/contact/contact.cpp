// SPDX-License-Identifier: MIT
#include "solver/contact/contact.hpp"

#include "base/parallel.hpp"
#include "grid/kernels.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
template <int Dim>
Contact<Dim>::Contact(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, Cracks<Dim>& cracks)
    : model_(model),
      system_(system),
      transfers_(transfers),
      cracks_(cracks),
      field_count_(system.fields.size()),
      cloud_(system.lattice, (reach_of(model.scheme.kernel) + 1.0) * system.lattice.spacing.maxCoeff()),
      face_solver_(system),
      h_(system.lattice.spacing.maxCoeff()) {
  const std::size_t n = field_count_;
  active_ = n > 1;
  if (!active_) return;
  const Transfer transfer = model.scheme.transfer;
  keeps_start_ = transfer == Transfer::flip || transfer == Transfer::blend || transfer == Transfer::xpic;

  laws_.assign(n * n, nullptr);
  for (auto* list : {&system.bodies, &system.rigids})
    for (auto& a : *list) {
      if (a.field < n) bodies_.push_back(&a);
      for (auto* others : {&system.bodies, &system.rigids})
        for (const auto& b : *others) {
          if (a.field >= n || b.field >= n || a.field == b.field) continue;
          const ContactLaw* law = model.contact.law(a.material, b.material);
          laws_[a.field * n + b.field] = law;
          remembers_ = remembers_ || law->remembers();
          interfaces_ = interfaces_ || law->interface();
          needs_areas_ = needs_areas_ || law->uses_area();
        }
    }
  needs_areas_ = needs_areas_ || model.heat.contact_heating || model.contact.normals != NormalMethod::margin;
  // Laws that look at displacements or memories want all particles near, in every step.
  keeps_faces_ = !interfaces_ && !remembers_ && model.contact.separation == Separation::edges;
  scratch_.resize(256);
  near_.assign(static_cast<std::size_t>(system.lattice.block_count()), 0);
  shared_at_.assign(near_.size(), -1);
}

template <int Dim>
void Contact<Dim>::locate() {
  if (!active_) return;
  for (const auto& s : shared_) shared_at_[static_cast<std::size_t>(s.block)] = -1;
  shared_.clear();
  std::map<std::int64_t, std::vector<std::pair<std::size_t, int>>> users;
  for (std::size_t f = 0; f < field_count_; ++f) {
    const auto& map = system_.fields[f].map;
    for (std::size_t slot = 0; slot < map.active().size(); ++slot)
      users[map.active()[slot]].emplace_back(f, static_cast<int>(slot));
  }
  for (auto& [block, slots] : users) {
    if (slots.size() < 2) continue;
    shared_at_[static_cast<std::size_t>(block)] = static_cast<int>(shared_.size());
    shared_.push_back({block, std::move(slots)});
  }
  forget();
  record_.assign(shared_.size() * block_nodes<Dim>, -1);
  nodes_.clear();
}

// Nodes that carry two or more fields, not all rigid.
template <int Dim>
void Contact<Dim>::list_nodes(const Exchanges<Dim>& exchanges) {
  std::fill(record_.begin(), record_.end(), -1);
  nodes_.clear(), members_.clear(), pairs_.clear();
  for (std::size_t s = 0; s < shared_.size(); ++s) {
    const SharedBlock& shared = shared_[s];
    for (int local = 0; local < block_nodes<Dim>; ++local) {
      int count = 0;
      for (const auto& [f, slot] : shared.slots) {
        const auto at = static_cast<std::int64_t>(slot) * block_nodes<Dim> + local;
        const double m = system_.fields[f].nodes[static_cast<std::size_t>(at)].mass;
        if (m > 0) ++count;
      }
      if (count < 2) continue;
      ContactNode node{};
      node.index = system_.fields[shared.slots[0].first].map.node_at(
          static_cast<std::int64_t>(shared.slots[0].second) * block_nodes<Dim> + local);
      node.number = static_cast<std::int64_t>(s) * block_nodes<Dim> + local;
      node.first_member = members_.size(), node.first_pair = pairs_.size();
      bool deformable = false;
      for (const auto& [f, slot] : shared.slots) {
        const auto at = static_cast<std::int64_t>(slot) * block_nodes<Dim> + local;
        const double m = system_.fields[f].nodes[static_cast<std::size_t>(at)].mass;
        if (!(m > 0)) continue;
        const bool rigid = system_.fields[f].rigid_contact;
        deformable = deformable || !rigid;
        ContactMember member;
        member.field = f, member.at = at, member.mass = m, member.inverse_mass = rigid ? 0.0 : 1.0 / m;
        members_.push_back(member);
      }
      node.end_member = members_.size();
      if (node.end_member - node.first_member < 2 || !deformable) {
        members_.resize(node.first_member);
        continue;
      }
      const ContactMember& first = members_[node.first_member];
      node.mirrored = exchanges[first.field]->mirrored_axes(node.index);
      node.share = exchanges[first.field]->ownership(first.at);
      list_pairs(node);
      record_[s * block_nodes<Dim> + static_cast<std::size_t>(local)] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
  }
}

// Bodies on the same side of all cracks meet by the law of their materials, fields on the two sides of one crack by
// its.
template <int Dim>
void Contact<Dim>::list_pairs(ContactNode& node) {
  for (std::size_t a = node.first_member; a < node.end_member; ++a)
    for (std::size_t b = a + 1; b < node.end_member; ++b) {
      const ContactMember &of_a = members_[a], &of_b = members_[b];
      const int between = system_.fields[of_a.field].side ^ system_.fields[of_b.field].side;
      if (of_a.inverse_mass + of_b.inverse_mass == 0.0 || between == 3) continue;
      ContactPair pair;
      pair.a = a, pair.b = b;
      pair.state.mass = 1.0 / (of_a.inverse_mass + of_b.inverse_mass);
      if (between == 0)
        pair.law = law_of(of_a.field, of_b.field), node.bodies = true;
      else
        pair.crack = 0;  // meet_cracks() finds out which
      pairs_.push_back(pair);
    }
  node.end_pair = pairs_.size();
}

template <int Dim>
void Contact<Dim>::meet_cracks() {
  if (!cracks_.active()) return;
  cracks_.find_carrying_nodes();
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    for (ContactPair& pair : pairs_of(node)) {
      if (pair.crack < 0) continue;
      const auto side = [&](std::size_t member) { return system_.fields[members_[member].field].side; };
      pair.apart = !cracks_.find_faces(pair, node.index, side(pair.a), side(pair.b));
      for (int d = 0; d < Dim; ++d)
        if (node.mirrored >> d & 1) pair.state.normal[d] = 0.0;
      pair.apart = pair.apart || !(pair.state.normal.norm() > 1e-6);
      if (!pair.apart) pair.state.normal.normalize();
    }
  });
}

// Volume, and its gradient in place of the force, of the bodies near meeting nodes: sum_p V_p grad w_Ip is the
// integral of the shape function over the surface times the outward normal.
template <int Dim>
void Contact<Dim>::scatter_volumes(const Exchanges<Dim>& exchanges) {
  std::fill(near_.begin(), near_.end(), 0);
  const auto& lattice = system_.lattice;
  for (const auto& node : nodes_) {
    if (!node.bodies) continue;
    // A stencil that reaches the node begins at most three nodes below it; one more for drift.
    Index<Dim> low, high;
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = std::max(0, (node.index[d] - 5) / block_edge<Dim>);
      high[d] = std::min(lattice.blocks[d] - 1, (node.index[d] + 1) / block_edge<Dim>);
    }
    Index<Dim> b = low;
    for (int z = Dim == 3 ? low[Dim - 1] : 0; z <= (Dim == 3 ? high[Dim - 1] : 0); ++z)
      for (b[1] = low[1]; b[1] <= high[1]; ++b[1])
        for (b[0] = low[0]; b[0] <= high[0]; ++b[0]) {
          if constexpr (Dim == 3) b[2] = z;
          near_[static_cast<std::size_t>(lattice.block_index(b))] = 1;
        }
  }
  for (std::size_t f = 0; f < field_count_; ++f) {
    auto& field = system_.fields[f];
    field.volumes.resize(field.nodes.size());
    std::fill(field.volumes.begin(), field.volumes.end(), VolumeNode{});
  }
  for (auto* body : bodies_) {
    transfers_.scatter(*body, Target<Dim>(*body, system_.fields, &Field<Dim>::volumes), Scatter::volume, false,
                       system_.analysis == Analysis::axisymmetric, &near_);
  }
  for (std::size_t f = 0; f < field_count_; ++f) exchanges[f]->sum_images(system_.fields[f].volumes);
}

template class Contact<2>;
template class Contact<3>;

}  // namespace tribo
