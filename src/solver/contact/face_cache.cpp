// SPDX-License-Identifier: MIT
#include "solver/contact/face_cache.hpp"

#include "base/parallel.hpp"
#include "base/ranks.hpp"
#include "solver/contact/face_geometry.hpp"
#include "solver/contact/face_tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

using namespace face_tolerance;

// Curved faces are valid for this travel, flat ones for more, as their normal and area do not depend on the place from
// which they are seen. The longest valid are flat faces that extend to all sides of the node, because no edge comes
// near it meanwhile [cells].
constexpr double curved_travel = 0.01, flat_travel = 0.05;
// A face extends to all sides of the node if it has particles at this distance along the face all around it [cells].
constexpr double surrounding_radius = 1.25;
// A face is found anew after this number of steps.
constexpr double max_steps = 200;
// If some faces are no longer valid, all that have spent this part of their travel or steps are found with them,
// because most of the cost of a search does not depend on the number of faces.
constexpr double nearly_spent = 0.7;
// A flat face is found anew if its depth range changes by this much: it has turned or bent [cells].
constexpr double max_depth_change = 0.01;
// The particles of a flat face reach equally far within this length. A face with that deviation within the reach of a
// node has a curvature for which the normal turns by 1e-3 along max_valid_travel; that changes the depth range by less
// than max_depth_change [cells].
constexpr double flatness = 0.02;

// Faces that stay farther apart than this exert no force, so that their normals do not matter [cells].
constexpr double open_gap = 0.1;
// The travels for which faces may be valid that are apart. There are few values, so that most faces expire together
// [cells].
constexpr std::array travels_apart{2 * curved_travel, flat_travel, 2 * flat_travel, max_valid_travel};

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

template <int Dim>
void FaceCache<Dim>::add_travel(const std::vector<double>& of_fields) {
  travel_.resize(system_.fields.size()), last_travel_ = of_fields;
  last_travel_.resize(system_.fields.size());
  for (std::size_t f = 0; f < of_fields.size(); ++f) travel_[f] += of_fields[f];
}

template <int Dim>
bool FaceCache<Dim>::has_spent(const ContactFace& face, double part) const {
  const double travel = std::max(travel_of(face.a) - face.found_travel[0], travel_of(face.b) - face.found_travel[1]);
  const auto steps = static_cast<double>(step_ - face.found_step);
  return travel > part * face.valid_travel || steps >= part * max_steps;
}

template <int Dim>
ContactFace& FaceCache<Dim>::new_face(std::size_t pair) {
  ContactFace& face = faces_[pair];
  face.begin();
  face.found_step = step_, face.found_travel = {travel_of(face.a), travel_of(face.b)};
  face.valid_travel = curved_travel, face.just_found = true;
  return face;
}

template <int Dim>
bool FaceCache<Dim>::reuse(ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies) {
  ++step_;
  travel_.resize(system_.fields.size()), last_travel_.resize(system_.fields.size());
  if (!enabled_) clear();
  assign_faces(contacts);
  find_domains(bodies);
  const auto count = static_cast<std::ptrdiff_t>(contacts.nodes.size());
  parallel_for(count, [&](std::ptrdiff_t k) { reuse_faces(contacts.nodes[static_cast<std::size_t>(k)], contacts); });
  for (ContactNode<Dim>& node : contacts.nodes)
    if (node.has_approached) measure_approached(node, contacts);
  const auto needs_faces = [](const ContactNode<Dim>& node) { return node.needs_faces; };
  if (!any_rank(std::any_of(contacts.nodes.begin(), contacts.nodes.end(), needs_faces))) return false;
  renew_with_others(contacts);
  return true;
}

// Gives the pairs of a node their kept faces with the present gaps.
template <int Dim>
void FaceCache<Dim>::reuse_faces(ContactNode<Dim>& node, ContactNodes<Dim>& contacts) {
  node.needs_faces = node.has_approached = false, node.idle = true;
  for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
    ContactPair& pair = contacts.pairs[p];
    ContactFace& face = faces_[p];
    const bool were_apart = face.apart;
    face.apart = false;
    const Kept kept = reuse_face(pair, face);
    face.has_approached = kept == Kept::normal && were_apart;
    const bool measures = kept == Kept::normal && !were_apart;
    pair.needs_face = kept == Kept::nothing || (measures && !measure_gap(node, contacts, pair, face));
    node.has_approached = node.has_approached || face.has_approached;
    node.needs_faces = node.needs_faces || pair.needs_face;
    node.idle = node.idle && !pair.may_touch() && pair.update_impulse.isZero(0);
  }
  node.idle = node.idle && !node.needs_faces;
}

// Measures the gaps of the pairs of a node that were apart in the last step, and are no longer.
template <int Dim>
void FaceCache<Dim>::measure_approached(ContactNode<Dim>& node, ContactNodes<Dim>& contacts) {
  for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
    ContactFace& face = faces_[p];
    if (!face.has_approached) continue;
    face.has_approached = false;
    for (const std::uint32_t number : face.particles)
      if (needed_[number] == 0) needed_[number] = 1, find_domain(particles_[number]);
    ContactPair& pair = contacts.pairs[p];
    pair.needs_face = !measure_gap(node, contacts, pair, face);
    node.needs_faces = node.needs_faces || pair.needs_face;
  }
}

// Finds the flat faces of a body anew together with its other faces that may touch, if most of these are found. The
// nodes beside each other on a round body then have normals of the same time; otherwise its shear force would vibrate
// while it rolls. Also finds faces that are nearly spent together with those that are spent.
template <int Dim>
void FaceCache<Dim>::renew_with_others(ContactNodes<Dim>& contacts) {
  // Per field, the numbers of its faces and of those that must be found; then whether some face is spent.
  counts_.assign(2 * system_.fields.size() + 1, 0);
  const auto all_of = [&](std::size_t field) -> std::int64_t& { return counts_[2 * system_.fields[field].base_field]; };
  const auto to_be_found = [&](std::size_t field) -> std::int64_t& {
    return counts_[2 * system_.fields[field].base_field + 1];
  };
  for (const ContactNode<Dim>& node : contacts.nodes)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      const ContactPair& pair = contacts.pairs[p];
      if (pair.crack >= 0 || !pair.law->uses_face()) continue;
      if (!node.own) continue;
      if (pair.needs_face && faces_[p].valid_travel != ContactFace::not_found) counts_.back() = 1;
      if (faces_[p].missing || stays_apart(faces_[p], pair)) continue;
      for (const std::size_t field : {faces_[p].a, faces_[p].b})
        ++all_of(field), to_be_found(field) += pair.needs_face ? 1 : 0;
    }
  ranks().add(counts_);
  const bool any_spent = counts_.back() > 0;
  const auto most = [&](std::size_t field) { return 2 * to_be_found(field) > all_of(field); };
  for (ContactNode<Dim>& node : contacts.nodes)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      const ContactPair& pair = contacts.pairs[p];
      if (pair.crack >= 0 || !pair.law->uses_face()) continue;
      const bool with_others = faces_[p].flat && (most(faces_[p].a) || most(faces_[p].b));
      if (with_others || (any_spent && has_spent(faces_[p], nearly_spent)))
        contacts.pairs[p].needs_face = node.needs_faces = true, node.idle = false;
    }
}

// Gives a pair its kept face. Faces that stay apart need no gap.
template <int Dim>
auto FaceCache<Dim>::reuse_face(ContactPair& pair, ContactFace& face) const -> Kept {
  if (pair.crack >= 0) return Kept::all;
  pair.has_no_face = face.missing;
  if (!pair.law->uses_face()) return Kept::all;
  if (has_spent(face, 1.0)) return Kept::nothing;
  if (face.missing) return Kept::all;
  pair.state.normal = face.normal, pair.state.area = face.area, pair.foremost_offset = face.foremost_offset;
  pair.apart = face.apart = stays_apart(face, pair);
  if (pair.apart) return pair.state.gap = least_gap(face), Kept::all;
  return std::ranges::max(face.count) > ContactFace::max_particles ? Kept::nothing : Kept::normal;
}

// The smallest gap that a pair can have at present, as its sides approach each other by at most their travel since the
// gap was measured [length].
template <int Dim>
double FaceCache<Dim>::least_gap(const ContactFace& face) const {
  const double travel = travel_of(face.a) - face.measured_travel[0] + travel_of(face.b) - face.measured_travel[1];
  return face.measured_gap - travel * h_;
}

// Whether the faces of a pair cannot meet in this step even if the bodies move twice as far as in the last one.
template <int Dim>
bool FaceCache<Dim>::stays_apart(const ContactFace& face, const ContactPair& pair) const {
  if (!pair.law->needs_closed_faces() || !pair.update_impulse.isZero(0)) return false;
  const auto last_travel = [&](std::size_t field) { return last_travel_[system_.fields[field].base_field]; };
  return least_gap(face) > std::max(open_gap, 2 * (last_travel(face.a) + last_travel(face.b))) * h_;
}

// Finds the present domains of the particles at faces that are not apart.
template <int Dim>
void FaceCache<Dim>::find_domains(const std::vector<Body<Dim>*>& bodies) {
  domains_.clear();
  for (auto* body : bodies) domains_.emplace_back(*body);
  needed_.resize(particles_.size(), 1);
  parallel_for(static_cast<std::ptrdiff_t>(particles_.size()), [&](std::ptrdiff_t k) {
    if (needed_[static_cast<std::size_t>(k)] != 0) find_domain(particles_[static_cast<std::size_t>(k)]);
  });
}

template <int Dim>
void FaceCache<Dim>::find_domain(CachedParticle& particle) const {
  const ParticleLabel& label = particle.label;
  particle.domain = ReachRows<Dim>(planes_.domain(domains_[label.body](label.particle), label.image));
}

// Measures the present gap of a pair at its kept face; false if the face has turned or bent.
template <int Dim>
bool FaceCache<Dim>::measure_gap(const ContactNode<Dim>& node, const ContactNodes<Dim>& contacts, ContactPair& pair,
                                 ContactFace& face) const {
  const Vec<Dim> centre = system_.lattice.position(node.index), n = face.normal.template head<Dim>();
  std::array<double, 2> positions;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec<Dim> out = side == 0 ? n : Vec<Dim>(-n);
    const double of_node = centre.dot(out);
    double most = -infinity, least = infinity, position = -infinity, nearest = infinity, of_nearest = -infinity;
    for (const std::uint32_t number : face.particles_of(side)) {
      const ReachRows<Dim>& domain = particles_[number].domain;
      const double reach = domain.reach(out) - of_node;
      most = std::max(most, reach), least = std::min(least, reach);
      if (reach <= position) continue;
      const Vec<Dim> x = domain.centre() - centre;
      const double offset_squared = x.squaredNorm() - x.dot(n) * x.dot(n);
      if (offset_squared <= band * band * h_ * h_) position = reach;
      if (offset_squared < nearest) nearest = offset_squared, of_nearest = reach;
    }
    if (face.flat && std::abs(most - least - face.depth_range[side]) > max_depth_change * h_) return false;
    if (position == -infinity) position = of_nearest;  // no particle lies in the band: see face_position
    positions[side] = position;
  }
  pair.state.gap = face.gap_correction - positions[0] - positions[1];
  pair.face_position =
      common_face_position(contacts.members[pair.a], contacts.members[pair.b], positions[0], -positions[1]);
  keep_gap(face, pair);
  return true;
}

template <int Dim>
void FaceCache<Dim>::keep_gap(ContactFace& face, const ContactPair& pair) const {
  face.measured_gap = pair.state.gap, face.measured_travel = {travel_of(face.a), travel_of(face.b)};
}

template <int Dim>
void FaceCache<Dim>::store(ContactFace& face, ContactPair& pair, NearParticles<Dim>& near) const {
  const Vec<Dim> n = face.normal.template head<Dim>();
  face.flat = near.wide && is_flat_face<Dim>(near.sides[0], n, flatness * h_) &&
              is_flat_face<Dim>(near.sides[1], -n, flatness * h_);
  if (face.flat) {
    const bool surrounds_node = surrounds_line<Dim>(near.sides[0], n, surrounding_radius * h_, flatness * h_) &&
                                surrounds_line<Dim>(near.sides[1], -n, surrounding_radius * h_, flatness * h_);
    face.valid_travel = surrounds_node ? max_valid_travel : flat_travel;
  }
  keep_gap(face, pair);
  pair.apart = face.apart = stays_apart(face, pair);
  if (!pair.law->interface() && pair.law->liquid() == 0) keep_longer(face, pair.state.gap - open_gap * h_);
  std::array<std::uint32_t, 2 * ContactFace::max_particles> numbers;
  auto end = numbers.begin();
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = near.sides[side];
    double most = -infinity, least = infinity;
    const Vec<Dim> out = side == 0 ? n : Vec<Dim>(-n);
    each_particle_at_face(of, out, band * h_, face.valid_travel * h_, cached_depth * h_, [&](std::size_t i) {
      most = std::max(most, of.reach[i]), least = std::min(least, of.reach[i]);
      if (face.count[side]++ < ContactFace::max_particles) *end++ = static_cast<std::uint32_t>(of.numbers[i]);
    });
    face.depth_range[side] = most - least;
  }
  face.particles.assign(numbers.begin(), end);
}

template <int Dim>
void FaceCache<Dim>::store_missing(ContactFace& face, double apart) const {
  keep_longer(face, apart);
}

// Keeps a face for a longer travel if its sides may approach each other by `apart` before it matters [length]. Two
// particles that approach each other do so by up to twice the travel.
template <int Dim>
void FaceCache<Dim>::keep_longer(ContactFace& face, double apart) const {
  for (const double travel : travels_apart)
    if (2 * travel * h_ <= apart && travel > face.valid_travel) face.valid_travel = travel, face.flat = false;
}

template class FaceCache<2>;
template class FaceCache<3>;

}  // namespace tribo
