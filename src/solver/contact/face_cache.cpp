// SPDX-License-Identifier: MIT
/// Finds where fields meet, and keeps normals and areas for as long as they serve.

#include "base/parallel.hpp"
#include "solver/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribo {
namespace {

// Faces are found anew when a particle may have moved this far [cells], or after so many steps; flat ones look the
// same from everywhere, and where they go on all around the node no edge comes near it.
constexpr double most_travel = 0.01, most_flat_travel = 0.05;
constexpr double inside = 1.25;  // that far around [cells]
constexpr int most_kept_steps = 200;
// Or when they turn: their relief changes by this much [cells].
constexpr double most_change = 0.01;
// Particles of flat faces reach equally far, but for this [cells]: within the reach of a node that is a curvature whose
// normals turn by 1e-3 along most_beside, less than most_change shows.
constexpr double even = 0.02;
// Cosine of the angle between the normals of a joint and of the face that goes on beyond it.
constexpr double same_normal = 0.866;

}  // namespace

template <int Dim>
void Contact<Dim>::find(const Exchanges<Dim>& exchanges, const Joints<Dim>& joints) {
  if (!active_) return;
  const auto lap = watch.lap();
  list_nodes(exchanges);
  meet_cracks();
  const bool kept = keeps_faces_ && kept_steps_ > 0 && !worn() && reuse_faces();
  const auto stale = std::count_if(nodes_.begin(), nodes_.end(), [](const ContactNode& node) { return node.stale; });
  if (!kept || 2 * static_cast<std::size_t>(stale) > nodes_.size())
    find_faces(exchanges, true);
  else if (stale > 0)
    find_faces(exchanges, false);
  kept_steps_ = keeps_faces_ ? kept_steps_ + 1 : 0;
  leave_to_joints(joints);
  gather_faces();
}

// Joints act wherever nodes feel them, but where the face goes on beyond the last joint by more than a cell. Where two
// bodies reach each other beyond the end of their common face the normal may be another, and joint and face are
// about equally far.
template <int Dim>
void Contact<Dim>::leave_to_joints(const Joints<Dim>& joints) {
  if (model_.contact.joints.empty()) return;
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      ContactPair& pair = pairs_[p];
      if (pair.crack >= 0) continue;
      const auto joint = joints.nearest_joint(system_.fields[members_[pair.a].field].home,
                                     system_.fields[members_[pair.b].field].home, system_.lattice.position(node.index));
      const Faces& face = faces_[face_of_[p]];
      const bool beyond = !pair.apart && pair.law->looks_at_faces() && joint.distance > face.beside + h_ &&
                          std::abs(face.normal.template head<Dim>().dot(joint.normal)) > same_normal;
      pair.jointed = std::isfinite(joint.distance) && !beyond;
    }
  });
}

// Finds the faces at all nodes or at the stale ones.
template <int Dim>
void Contact<Dim>::find_faces(const Exchanges<Dim>& exchanges, bool all) {
  if (all) {
    moved_ = 0.0, kept_steps_ = 0;
    for (ContactNode& node : nodes_) node.stale = node.bodies;
    faces_.resize(pairs_.size());
    face_of_.resize(pairs_.size());
    std::iota(face_of_.begin(), face_of_.end(), std::size_t{0});
    kept_.clear();
  }
  collect();
  const bool bodies = std::any_of(nodes_.begin(), nodes_.end(), [](const ContactNode& node) { return node.bodies; });
  if (bodies && (all || needs_areas_)) scatter_volumes(exchanges);
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    if (!node.stale) return;
    Scratch& scratch = scratch_[static_cast<std::size_t>(thread_index()) % scratch_.size()];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      Faces& found = faces_[face_of_[p]];
      found.found = moved_, found.serves = most_travel, found.just_found = true;
      face(node, pairs_[p], found, scratch);
    }
  });
  if (keeps_faces_) number_kept();
}

// The particles near the stale nodes, as they are now.
template <int Dim>
void Contact<Dim>::collect() {
  cloud_.begin();
  for (const auto& node : nodes_)
    if (node.stale) cloud_.want(node.index);
  cloud_.collect(bodies_);
}

template <int Dim>
bool Contact<Dim>::worn() const {
  return moved_ > most_beside || kept_steps_ >= most_kept_steps;
}

// Gives every pair the faces found before, and tells which nodes need new ones; false if some pair is new.
template <int Dim>
bool Contact<Dim>::reuse_faces() {
  const auto place = [](std::int64_t number, std::size_t a, std::size_t b) { return std::tuple(number, a, b); };
  std::size_t f = 0;
  face_of_.resize(pairs_.size());
  for (const ContactNode& node : nodes_)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      const auto wanted = place(node.number, members_[pairs_[p].a].field, members_[pairs_[p].b].field);
      const auto at = [&] { return place(faces_[f].node, faces_[f].a, faces_[f].b); };
      while (f < faces_.size() && at() < wanted) ++f;
      if (f == faces_.size() || at() != wanted) return false;
      face_of_[p] = f;
    }
  domains_.clear();
  for (auto* body : bodies_) domains_.emplace_back(*body);
  parallel_for(static_cast<std::ptrdiff_t>(kept_.size()), [&](std::ptrdiff_t k) {
    Kept& kept = kept_[static_cast<std::size_t>(k)];
    kept.point = domains_[kept.label.body](kept.label.particle);
  });
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    ContactNode& node = nodes_[static_cast<std::size_t>(k)];
    node.stale = false;
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p)
      node.stale = !reuse(node, pairs_[p], faces_[face_of_[p]]) || node.stale;
  });
  return true;
}

// Gives a pair the faces found before, with the gap of now; false if they no longer serve.
template <int Dim>
bool Contact<Dim>::reuse(const ContactNode& node, ContactPair& pair, const Faces& face) const {
  if (pair.crack >= 0) return true;
  pair.apart = face.apart;
  if (!pair.law->looks_at_faces()) return true;
  // All faces of a kind become old at the same time: it takes one search for all.
  const auto age = [&](double travel) { return std::floor(travel / face.serves); };
  if (age(moved_) > age(face.found)) return false;
  if (face.apart) return true;
  if (face.count[0] > Faces::most || face.count[1] > Faces::most) return false;
  pair.state.normal = face.normal, pair.state.area = face.area;
  const Vec<Dim> centre = system_.lattice.position(node.index), n = face.normal.template head<Dim>();
  std::array<double, 2> positions;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec<Dim> out = side == 0 ? n : Vec<Dim>(-n);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double most = -infinity, least = infinity, position = -infinity, nearest = infinity, of_nearest = -infinity;
    for (std::size_t k = 0; k < face.count[side]; ++k) {
      const ParticleDomain<Dim>& point = kept_[face.corners[side][k]].point;
      const double reach = point.reach(centre, out);
      most = std::max(most, reach), least = std::min(least, reach);
      if (reach <= position) continue;
      const Vec<Dim> x = point.x - centre;
      const double sideways = x.squaredNorm() - x.dot(n) * x.dot(n);
      if (sideways <= band * band * h_ * h_) position = reach;
      if (sideways < nearest) nearest = sideways, of_nearest = reach;
    }
    if (face.flat && std::abs(most - least - face.relief[side]) > most_change * h_) return false;
    if (position == -infinity) position = of_nearest;  // the node lies beside the face
    positions[side] = position;
  }
  pair.state.gap = face.play - positions[0] - positions[1];
  pair.face = face_between(pair, positions[0], -positions[1]);
  return true;
}

// Keeps whatever may become the outermost particle before the faces are found again.
template <int Dim>
void Contact<Dim>::keep(Faces& kept, Scratch& s, const Vec<Dim>& n) const {
  kept.flat = s.wide && flat_face<Dim>(s.sides[0], n, even * h_) && flat_face<Dim>(s.sides[1], -n, even * h_);
  if (kept.flat) {
    const bool all_around =
        goes_on<Dim>(s.sides[0], n, inside * h_, even * h_) && goes_on<Dim>(s.sides[1], -n, inside * h_, even * h_);
    kept.serves = all_around ? most_beside : most_flat_travel;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = s.sides[side];
    double most = -std::numeric_limits<double>::infinity(), least = -most;
    const Vec<Dim> out = side == 0 ? n : Vec<Dim>(-n);
    each_at_face(of, out, band * h_, kept.serves * h_, kept_depth * h_, [&](std::size_t i) {
      most = std::max(most, of.reach[i]), least = std::min(least, of.reach[i]);
      const std::size_t k = kept.count[side]++;
      if (k < Faces::most) kept.corners[side][k] = static_cast<std::uint32_t>(of.which[i]);
    });
    kept.relief[side] = most - least;
  }
}

// Lists the particles that make the faces just found in the order of the cloud, which is nearly that in memory; faces
// share them. Drops those that no face needs any more once they are many.
template <int Dim>
void Contact<Dim>::number_kept() {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const auto each_corner = [this](bool new_ones, auto&& f) {
    for (Faces& face : faces_)
      for (std::size_t side = 0; side < 2 && face.just_found == new_ones; ++side)
        for (std::size_t k = 0; k < std::min(face.count[side], Faces::most); ++k) f(face.corners[side][k]);
  };
  const auto renumber = [&](bool new_ones, std::size_t count, auto&& move) {
    kept_number_.assign(count, none);
    each_corner(new_ones, [&](std::uint32_t corner) { kept_number_[corner] = 0; });
    for (std::size_t k = 0; k < count; ++k)
      if (kept_number_[k] != none) kept_number_[k] = static_cast<std::uint32_t>(move(k));
    each_corner(new_ones, [&](std::uint32_t& corner) { corner = kept_number_[corner]; });
  };
  const bool many = 4 * kept_.size() > 5 * needed_;
  if (many) {
    std::size_t used = 0;
    renumber(false, kept_.size(), [&](std::size_t k) { return kept_[used] = kept_[k], used++; });
    kept_.resize(used);
  }
  const bool first = kept_.empty();
  renumber(true, cloud_.size(), [&](std::size_t k) {
    kept_.push_back({cloud_.label(k), cloud_.point(k)});
    return kept_.size() - 1;
  });
  if (many || first) needed_ = kept_.size();
  for (Faces& face : faces_) face.just_found = false;
}

// Hands the pairs whose impulses act on faces, and those that share a node with them, to their solver.
template <int Dim>
void Contact<Dim>::gather_faces() {
  if (!model_.contact.at_faces) return;
  face_solver_.clear();
  const auto has_face = [](const ContactPair& pair) {
    return !pair.apart && !pair.jointed && pair.crack < 0 && pair.law->looks_at_faces();
  };
  for (ContactNode& node : nodes_) {
    const auto pairs = pairs_of(node);
    node.by_faces = std::any_of(pairs.begin(), pairs.end(), has_face);
    if (!node.by_faces) continue;
    for (ContactPair& pair : pairs) face_solver_.add(pair, members_, node.index, has_face(pair));
  }
}

template void Contact<2>::find(const Exchanges<2>&, const Joints<2>&);
template bool Contact<2>::worn() const;
template void Contact<2>::collect();
template void Contact<2>::keep(Faces&, Scratch&, const Vec<2>&) const;
template void Contact<3>::find(const Exchanges<3>&, const Joints<3>&);
template bool Contact<3>::worn() const;
template void Contact<3>::collect();
template void Contact<3>::keep(Faces&, Scratch&, const Vec<3>&) const;

}  // namespace tribo
