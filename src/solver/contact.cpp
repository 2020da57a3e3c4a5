#include "solver/contact.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Faces are found anew when a particle may have moved this far [cells], or after so many steps.
constexpr double most_travel = 0.01;
constexpr int most_kept_steps = 50;

}  // namespace
template <int Dim>
Contact<Dim>::Contact(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers)
    : model_(model),
      system_(system),
      transfers_(transfers),
      field_count_(system.fields.size()),
      cloud_(system.lattice),
      face_impulses_(system) {
  const std::size_t n = field_count_;
  active_ = model.contact.active && n > 1;
  if (!active_) return;
  const Transfer transfer = model.scheme.transfer;
  keeps_start_ = transfer == Transfer::flip || transfer == Transfer::blend || transfer == Transfer::xpic;
  h_ = system.lattice.spacing.maxCoeff();
  const Kernel kernel = model.scheme.kernel;
  reach_ = h_ * (kernel == Kernel::cubic_spline ? 3.0 : kernel == Kernel::quadratic_spline ? 2.5 : 2.0);

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
        }
    }
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

template <int Dim>
void Contact<Dim>::find(std::vector<Conditions<Dim>>& conditions) {
  if (!active_) return;
  list_nodes(conditions);
  if (keeps_faces_ && kept_steps_ > 0 && !worn() && recall_faces()) {
    ++kept_steps_;
    gather_faces();
    return;
  }
  cloud_.begin(reach_);
  for (const auto& node : nodes_) cloud_.want(node.index);
  cloud_.collect(bodies_);
  scatter_volumes(conditions);
  found_.resize(pairs_.size());
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const MeetingNode& node = nodes_[static_cast<std::size_t>(k)];
    Scratch& scratch = scratch_[static_cast<std::size_t>(thread_index()) % scratch_.size()];
    scratch.near.clear();
    cloud_.each_near(node.index, [&](const CloudPoint<Dim>& p) { scratch.near.push_back(&p); });
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) face(node, pairs_[p], found_[p], scratch);
  });
  keep_faces();
  gather_faces();
}

// Hands the pairs whose impulses act on faces, and those that share a node with them, to their solver.
template <int Dim>
void Contact<Dim>::gather_faces() {
  if (!model_.contact.at_faces) return;
  face_impulses_.clear();
  const auto has_face = [](const ContactPair& pair) { return !pair.apart && pair.law->looks_at_faces(); };
  for (MeetingNode& node : nodes_) {
    const auto pairs = pairs_of(node);
    node.by_faces = std::any_of(pairs.begin(), pairs.end(), has_face);
    if (!node.by_faces) continue;
    for (ContactPair& pair : pairs) face_impulses_.add(pair, members_, node.index, has_face(pair));
  }
}

template <int Dim>
bool Contact<Dim>::worn() const {
  return moved_ > most_travel || kept_steps_ >= most_kept_steps;
}

// Gives every pair the faces found before; false if some pair is new.
template <int Dim>
bool Contact<Dim>::recall_faces() {
  std::size_t f = 0;
  face_of_.resize(pairs_.size());
  for (const MeetingNode& node : nodes_)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      const auto before = [&](const Faces& face) {
        return std::tuple(face.node, face.a, face.b) <
               std::tuple(node.number, members_[pairs_[p].a].field, members_[pairs_[p].b].field);
      };
      while (f < faces_.size() && before(faces_[f])) ++f;
      if (f == faces_.size() || faces_[f].node != node.number || faces_[f].a != members_[pairs_[p].a].field ||
          faces_[f].b != members_[pairs_[p].b].field)
        return false;
      face_of_[p] = f;
    }
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const MeetingNode& node = nodes_[static_cast<std::size_t>(k)];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      const Faces& face = faces_[face_of_[p]];
      ContactPair& pair = pairs_[p];
      pair.apart = face.apart;
      if (face.apart || !pair.law->looks_at_faces()) continue;
      pair.meeting.normal = face.normal, pair.meeting.area = face.area;
      pair.face = face.face;
      pair.meeting.gap = kept_gap(node, pair, face);
    }
  });
  return true;
}

template <int Dim>
void Contact<Dim>::keep_faces() {
  moved_ = 0.0, kept_steps_ = 0;
  if (!keeps_faces_) return;
  for (const Faces& face : found_)
    if (face.count[0] > Faces::most || face.count[1] > Faces::most) return;
  std::swap(faces_, found_);
  kept_steps_ = 1;
}

template <int Dim>
double Contact<Dim>::kept_gap(const MeetingNode& node, const ContactPair&, const Faces& face) const {
  const Vec<Dim> centre = system_.lattice.position(node.index), n = face.normal.template head<Dim>();
  double gap = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec<Dim> out = side == 0 ? n : Vec<Dim>(-n);
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < face.count[side]; ++k) {
      const auto& corner = face.corners[side][k];
      const auto p = cloud_.point(*bodies_[corner.body], corner.body, corner.particle);
      double reach = (p.x - centre).dot(out);
      for (int axis = 0; axis < Dim; ++axis) reach += std::abs(p.axes.col(axis).dot(out));
      most = std::max(most, reach);
    }
    gap -= most;
  }
  return gap;
}

// Nodes that carry two or more fields, not all rigid.
template <int Dim>
void Contact<Dim>::list_nodes(std::vector<Conditions<Dim>>& conditions) {
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
      MeetingNode node{};
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
      node.mirrored = conditions[first.field].mirrored(node.index);
      node.share = conditions[first.field].share(first.at);
      for (std::size_t a = node.first_member; a < node.end_member; ++a)
        for (std::size_t b = a + 1; b < node.end_member; ++b) {
          if (members_[a].inverse_mass + members_[b].inverse_mass == 0.0) continue;
          ContactPair pair;
          pair.a = a, pair.b = b;
          pair.law = law_of(members_[a].field, members_[b].field);
          pair.meeting.mass = 1.0 / (members_[a].inverse_mass + members_[b].inverse_mass);
          pairs_.push_back(pair);
        }
      node.end_pair = pairs_.size();
      record_[s * block_nodes<Dim> + static_cast<std::size_t>(local)] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
  }
}

// Volume, and its gradient in place of the force, of the bodies near meeting nodes: sum_p V_p grad w_Ip is the
// integral of the shape function over the surface times the outward normal.
template <int Dim>
void Contact<Dim>::scatter_volumes(std::vector<Conditions<Dim>>& conditions) {
  std::fill(near_.begin(), near_.end(), 0);
  const auto& lattice = system_.lattice;
  for (const auto& node : nodes_) {
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
    std::fill(field.volumes.begin(), field.volumes.end(), Node{});
  }
  for (auto* body : bodies_) {
    auto& field = system_.fields[body->field];
    transfers_.scatter(*body, field.map, field.volumes, Scatter::volume, false,
                       system_.analysis == Analysis::axisymmetric, &near_);
  }
  for (std::size_t f = 0; f < field_count_; ++f) conditions[f].fold(system_.fields[f].volumes);
}

template class Contact<2>;
template class Contact<3>;

}  // namespace tribo
