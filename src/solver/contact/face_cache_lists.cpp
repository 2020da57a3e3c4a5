// SPDX-License-Identifier: MIT
/// The lists of faces and particles of a FaceCache.

#include "base/parallel.hpp"
#include "solver/contact/face_cache.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace tribo {

// Assigns the faces to the pairs of this step: the kept ones, and for new pairs faces that must be found.
template <int Dim>
void FaceCache<Dim>::assign_faces(const ContactNodes<Dim>& contacts) {
  const auto& parts = contacts.parts;
  const bool all = contacts.moved || faces_.size() != contacts.pairs.size();
  if (all) next_.resize(contacts.pairs.size());
  live_.resize(parts.size(), {0, 0});
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const auto part = static_cast<std::size_t>(k);
    if (all || parts[part].changed) assign_faces(contacts, part, all ? next_ : faces_);
  });
  if (all) std::swap(faces_, next_);
  is_compact_ = false;
}

// Assigns the faces of the pairs of a part. Faces that were restored from a checkpoint belong to no part yet.
template <int Dim>
void FaceCache<Dim>::assign_faces(const ContactNodes<Dim>& contacts, std::size_t number, std::vector<ContactFace>& to) {
  const ContactPart& part = contacts.parts[number];
  thread_local std::vector<ContactFace> of_part;
  std::span<const ContactFace> kept(faces_);
  if (!is_compact_) {
    const auto old = kept.subspan(live_[number].first, live_[number].count);
    of_part.assign(old.begin(), old.end()), kept = of_part;
  }
  for (std::size_t n = part.first_node; n < part.end_node; ++n) {
    const ContactNode<Dim>& node = contacts.nodes[n];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      const std::tuple key(node.number, contacts.members[contacts.pairs[p].a].field,
                           contacts.members[contacts.pairs[p].b].field);
      const auto face = std::ranges::lower_bound(kept, key, {}, &ContactFace::key);
      if (face != kept.end() && face->key() == key) {
        to[p] = *face;
      } else {
        to[p] = {};
        std::tie(to[p].node, to[p].a, to[p].b) = key;
      }
    }
  }
  for (std::size_t p = part.end_pair; p < part.first_pair + part.pair_room; ++p) to[p] = {};
  live_[number] = {part.first_pair, part.end_pair - part.first_pair};
}

// Calls f(number) for the particles of the faces that were found in this step, or of the others.
template <int Dim>
template <class F>
void FaceCache<Dim>::each_particle_number(bool just_found, F&& f) {
  for (ContactFace& face : faces_)
    if (face.just_found == just_found) std::ranges::for_each(face.particles, f);
}

// Replaces the numbers 0 to count - 1 of the particles of these faces by new_number(old number), called in ascending
// order for the numbers that occur.
template <int Dim>
template <class F>
void FaceCache<Dim>::renumber(bool just_found, std::size_t count, F&& new_number) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  new_numbers_.assign(count, none);
  each_particle_number(just_found, [&](std::uint32_t number) { new_numbers_[number] = 0; });
  for (std::size_t k = 0; k < count; ++k)
    if (new_numbers_[k] != none) new_numbers_[k] = static_cast<std::uint32_t>(new_number(k));
  each_particle_number(just_found, [&](std::uint32_t& number) { number = new_numbers_[number]; });
}

// Faces share particles. They are listed in the order of the cloud, which is nearly that in memory. Particles that no
// face needs any more are removed once there are many.
template <int Dim>
void FaceCache<Dim>::end_search(const ParticleCloud<Dim>& cloud) {
  if (!enabled_) return;
  const bool many_unused = 4 * particles_.size() > 5 * compact_size_;
  if (many_unused) {
    std::size_t used = 0;
    renumber(false, particles_.size(), [&](std::size_t k) { return particles_[used] = particles_[k], used++; });
    particles_.resize(used);
  }
  const bool first = particles_.empty();
  renumber(true, cloud.size(), [&](std::size_t k) {
    particles_.push_back({cloud.label(k), ReachRows<Dim>(cloud.domain(k))});
    return particles_.size() - 1;
  });
  if (many_unused || first) compact_size_ = particles_.size();
  // Particles whose last face has come apart stay needed until the list is compact again.
  needed_.resize(particles_.size(), 0);
  if (many_unused || first) std::fill(needed_.begin(), needed_.end(), 0);
  for (ContactFace& face : faces_) {
    if ((face.just_found || many_unused) && !face.apart)
      for (const std::uint32_t number : face.particles) needed_[number] = 1;
    face.just_found = false;
  }
}

// The faces of the last step in the order of their keys.
template <int Dim>
std::vector<ContactFace*> FaceCache<Dim>::live_faces() {
  std::vector<ContactFace*> live;
  const auto add = [&](std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) live.push_back(&faces_[k]);
  };
  if (is_compact_) {
    add(0, faces_.size());
  } else {
    for (const Range& range : live_) add(range.first, range.count);
  }
  return live;
}

template <int Dim>
void FaceCache<Dim>::archive_faces(Archive& a) {
  std::size_t count = a.reading() ? 0 : live_faces().size();
  a("faces.size", count);
  if (a.reading()) faces_.assign(count, {}), is_compact_ = true;
  auto live = live_faces();
  a("faces", live);
  archive_particles(a, live);
}

// Without their domains, which reuse() computes in every step.
template <int Dim>
void FaceCache<Dim>::archive_particles(Archive& a, const std::vector<ContactFace*>& faces) {
  std::vector<std::int64_t> labels, members;
  for (const CachedParticle& p : particles_)
    labels.insert(labels.end(), {p.label.field, p.label.body, p.label.particle, p.label.image});
  for (const ContactFace* face : faces) members.insert(members.end(), face->particles.begin(), face->particles.end());
  a.resizable("particles", labels), a.resizable("members", members);
  if (!a.reading()) return;
  const auto number = [](std::int64_t n) {
    if (n < 0 || n > std::numeric_limits<std::uint32_t>::max())
      refuse_checkpoint("the number of a particle at a face of contact");
    return static_cast<std::uint32_t>(n);
  };
  particles_.resize(labels.size() / 4);
  for (std::size_t k = 0; k < particles_.size(); ++k)
    particles_[k].label = {number(labels[4 * k]), number(labels[4 * k + 1]), number(labels[4 * k + 2]),
                           number(labels[4 * k + 3])};
  auto from = members.begin();
  for (ContactFace* face : faces) {
    face->particles.assign(face->listed(0) + face->listed(1), 0);
    for (std::uint32_t& particle : face->particles)
      if (from != members.end()) particle = number(*from++);
  }
}

template <int Dim>
bool FaceCache<Dim>::fits(const std::vector<Body<Dim>*>& bodies) const {
  const auto exists = [&](const CachedParticle& p) {
    return p.label.body < bodies.size() && p.label.particle < bodies[p.label.body]->particles.size() &&
           p.label.field == bodies[p.label.body]->field && planes_.exists(p.label.image);
  };
  const auto complete = [&](const ContactFace& face) {
    return std::ranges::all_of(face.particles, [&](std::uint32_t number) { return number < particles_.size(); });
  };
  return std::all_of(particles_.begin(), particles_.end(), exists) &&
         std::all_of(faces_.begin(), faces_.end(), complete);
}

template void FaceCache<2>::assign_faces(const ContactNodes<2>&);
template void FaceCache<3>::assign_faces(const ContactNodes<3>&);
template void FaceCache<2>::end_search(const ParticleCloud<2>&);
template void FaceCache<3>::end_search(const ParticleCloud<3>&);
template void FaceCache<2>::archive_faces(Archive&);
template void FaceCache<3>::archive_faces(Archive&);
template bool FaceCache<2>::fits(const std::vector<Body<2>*>&) const;
template bool FaceCache<3>::fits(const std::vector<Body<3>*>&) const;

}  // namespace tribo
