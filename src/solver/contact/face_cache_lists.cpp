// SPDX-License-Identifier: MIT
/// The lists of faces and particles of a FaceCache.

#include "base/bytes.hpp"
#include "base/parallel.hpp"
#include "solver/contact/face_cache.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <tuple>

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

// The particles of each face one after the other, so that the list does not depend on when the faces were found.
// Domains are computed in every step by reuse().
template <int Dim>
void FaceCache<Dim>::archive_particles(Archive& a, const std::vector<ContactFace*>& faces) {
  std::vector<std::int64_t> numbers;
  for (const ContactFace* face : faces)
    for (const std::uint32_t at : face->particles) {
      const ParticleLabel& p = particles_[at].label;
      numbers.insert(numbers.end(), {p.field, p.body, p.particle, p.image});
    }
  a.resizable("particles", numbers);
  if (!a.reading()) return;
  const auto number = [](std::int64_t n) {
    if (n < 0 || n > std::numeric_limits<std::uint32_t>::max())
      refuse_checkpoint("the number of a particle at a face of contact");
    return static_cast<std::uint32_t>(n);
  };
  std::vector<ParticleLabel> labels;
  for (std::size_t k = 0; k + 4 <= numbers.size(); k += 4)
    labels.push_back({number(numbers[k]), number(numbers[k + 1]), number(numbers[k + 2]), number(numbers[k + 3])});
  std::size_t listed = 0;
  for (const ContactFace* face : faces) listed += face->listed(0) + face->listed(1);
  if (listed != labels.size()) refuse_checkpoint("the faces of contact and their particles differ in number");
  number_particles(faces, labels);
}

// Lists the particles once each, and gives the faces their numbers. `labels`: of the particles of the faces, one face
// after the other.
template <int Dim>
void FaceCache<Dim>::number_particles(const std::vector<ContactFace*>& faces,
                                      const std::vector<ParticleLabel>& labels) {
  const auto key = [](const ParticleLabel& p) { return std::tuple(p.body, p.particle, p.image, p.field); };
  std::vector<ParticleLabel> once = labels;
  std::ranges::sort(once, {}, key);
  const auto same = [&](const ParticleLabel& one, const ParticleLabel& other) { return key(one) == key(other); };
  once.erase(std::unique(once.begin(), once.end(), same), once.end());
  particles_.clear(), needed_.clear();
  for (const ParticleLabel& label : once) particles_.push_back({label, {}});
  compact_size_ = particles_.size();
  auto label = labels.begin();
  for (ContactFace* face : faces) {
    face->particles.clear();
    for (std::size_t k = face->listed(0) + face->listed(1); k > 0; --k, ++label)
      face->particles.push_back(
          static_cast<std::uint32_t>(std::ranges::lower_bound(once, key(*label), {}, key) - once.begin()));
  }
}

namespace {

// The bytes of all that is known of a face but its particles.
struct FaceRecord {
  std::int64_t node, found_step;
  std::array<std::size_t, 2> fields, count;
  std::array<double, 3> normal, foremost_offset;
  double area, gap_correction, offset_along_face, valid_travel, measured_gap;
  std::array<double, 2> found_travel, measured_travel, depth_range;
  std::array<bool, 8> flags;  // missing, apart, has_approached, flat; the others fill the structure
};

std::array<double, 3> array_of(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

FaceRecord record_of(const ContactFace& f) {
  return {f.node,
          f.found_step,
          {f.a, f.b},
          f.count,
          array_of(f.normal),
          array_of(f.foremost_offset),
          f.area,
          f.gap_correction,
          f.offset_along_face,
          f.valid_travel,
          f.measured_gap,
          f.found_travel,
          f.measured_travel,
          f.depth_range,
          {f.missing, f.apart, f.has_approached, f.flat}};
}

ContactFace face_of(const FaceRecord& r) {
  ContactFace f;
  f.node = r.node, f.found_step = r.found_step, f.a = r.fields[0], f.b = r.fields[1], f.count = r.count;
  f.normal = vector_of(r.normal), f.foremost_offset = vector_of(r.foremost_offset);
  f.area = r.area, f.gap_correction = r.gap_correction, f.offset_along_face = r.offset_along_face;
  f.valid_travel = r.valid_travel, f.measured_gap = r.measured_gap;
  f.found_travel = r.found_travel, f.measured_travel = r.measured_travel, f.depth_range = r.depth_range;
  f.missing = r.flags[0], f.apart = r.flags[1], f.has_approached = r.flags[2], f.flat = r.flags[3];
  return f;
}

// A particle by the bin in which it is, and its place there.
struct PortableLabel {
  std::int64_t block;
  std::uint32_t place, body, image, field;
};

}  // namespace

template <int Dim>
std::vector<std::byte> FaceCache<Dim>::portable_faces(const std::vector<Body<Dim>*>& bodies, bool own_only) {
  ByteWriter out;
  for (const ContactFace* face : live_faces()) {
    if (own_only && !system_.partition->is_own(system_.lattice.block_at(face->node / block_nodes<Dim>))) continue;
    out.value(record_of(*face));
    std::vector<PortableLabel> labels;
    for (const std::uint32_t at : face->particles) {
      const ParticleLabel& p = particles_[at].label;
      const auto bins = bodies[p.body]->bins.with_ghosts();
      const auto bin = std::ranges::upper_bound(bins, p.particle, {}, &Bin::begin) - 1;
      labels.push_back({bin->block, p.particle - bin->begin, p.body, p.image, p.field});
    }
    out.list(labels);
  }
  return std::move(out.data);
}

template <int Dim>
void FaceCache<Dim>::take_faces(const std::vector<std::vector<std::byte>>& lists,
                                const std::vector<Body<Dim>*>& bodies) {
  former_ =
      Lists{std::move(faces_), std::move(live_), std::move(particles_), std::move(needed_), is_compact_, compact_size_};
  clear();
  struct Taken {
    ContactFace face;
    std::vector<ParticleLabel> labels;
  };
  std::vector<Taken> taken;
  for (const auto& list : lists)
    for (ByteReader reader(list); !reader.at_end();) {
      Taken next{face_of(reader.value<FaceRecord>()), {}};
      const auto labels = reader.list<PortableLabel>();
      for (const PortableLabel& p : labels) {
        const auto& of_body = bodies[p.body]->bins;
        const auto bins = of_body.with_ghosts();
        const auto at =
            std::ranges::lower_bound(of_body.by_block(), p.block, {}, [&](std::uint32_t k) { return bins[k].block; });
        if (at == of_body.by_block().end() || bins[*at].block != p.block) break;
        next.labels.push_back({p.field, p.body, bins[*at].begin + p.place, p.image});
      }
      if (next.labels.size() == labels.size()) taken.push_back(std::move(next));
    }
  std::ranges::sort(taken, {}, [](const Taken& t) { return t.face.key(); });
  std::vector<ParticleLabel> labels;
  for (Taken& t : taken) {
    faces_.push_back(std::move(t.face));
    labels.insert(labels.end(), t.labels.begin(), t.labels.end());
  }
  number_particles(live_faces(), labels);
}

template <int Dim>
void FaceCache<Dim>::return_faces() {
  if (!former_) return;
  faces_ = std::move(former_->faces), live_ = std::move(former_->live), particles_ = std::move(former_->particles);
  needed_ = std::move(former_->needed), is_compact_ = former_->is_compact, compact_size_ = former_->compact_size;
  former_.reset();
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
template std::vector<std::byte> FaceCache<2>::portable_faces(const std::vector<Body<2>*>&, bool);
template std::vector<std::byte> FaceCache<3>::portable_faces(const std::vector<Body<3>*>&, bool);
template void FaceCache<2>::take_faces(const std::vector<std::vector<std::byte>>&, const std::vector<Body<2>*>&);
template void FaceCache<3>::take_faces(const std::vector<std::vector<std::byte>>&, const std::vector<Body<3>*>&);
template void FaceCache<2>::return_faces();
template void FaceCache<3>::return_faces();
template bool FaceCache<2>::fits(const std::vector<Body<2>*>&) const;
template bool FaceCache<3>::fits(const std::vector<Body<3>*>&) const;

}  // namespace tribo
