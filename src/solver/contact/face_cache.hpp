// SPDX-License-Identifier: MIT
/// Contact faces that are kept from step to step.
#pragma once

#include "base/archive.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/contact/near_particles.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace tribo {

/// The common face of a pair as it was last found from the particles, and the particles that determine its gap.
struct ContactFace {
  static constexpr std::size_t max_particles = 32;  ///< per side; a face with more is not cached

  std::int64_t node = -1;       ///< ContactNode::number
  std::size_t a = 0, b = 0;     ///< fields
  bool missing = false;         ///< the pair has no common face at this node
  Vec3 normal = Vec3::Zero();   ///< unit normal from a to b
  double area = 0.0;            ///< share of the node in the contact area                             [length^2]
  double gap_correction = 0.0;  ///< added to the gap between the foremost particles, see gap_correction()  [length]
  Vec3 foremost_offset = Vec3::Zero();  ///< see ContactPair::foremost_offset
  double offset_along_face = 0.0;  ///< distance along the face from the node to the nearest particles at it   [length]

  bool just_found = false;              ///< in this step
  double found_travel = 0.0;            ///< travel of the cache when it was found                             [cells]
  double valid_travel = 0.0;            ///< it is valid for so much travel                                    [cells]
  bool flat = false;                    ///< both sides are plane, so it looks the same from everywhere until it turns
  std::array<double, 2> depth_range{};  ///< per side: largest minus smallest reach of the particles    [length]
  std::array<std::size_t, 2> count{};   ///< per side: number of particles; may exceed max_particles
  /// Per side: numbers in the cloud while just_found, later numbers in the list of cached particles.
  std::array<std::array<std::uint32_t, max_particles>, 2> particles{};

  /// Number of particles in the list of a side.
  std::ptrdiff_t listed(std::size_t side) const {
    return static_cast<std::ptrdiff_t>(std::min(count[side], max_particles));
  }
  /// Starts anew for a pair of fields at a node.
  void begin(std::int64_t number, std::size_t field_a, std::size_t field_b) {
    node = number, a = field_a, b = field_b;
    count = {};
    missing = false;
  }
};

/// Saves and restores a face. The numbers of its particles are saved by FaceCache.
inline void archive(Archive& a, ContactFace& face) {
  auto& [node, field_a, field_b, missing, normal, area, gap_correction, foremost_offset, offset_along_face, just_found,
         found_travel, valid_travel, flat, depth_range, count, particles] = face;
  a.version(2);
  a("node", node), a("a", field_a), a("b", field_b), a("missing", missing);
  a("normal", normal), a("area", area), a("gap_correction", gap_correction);
  a("foremost_offset", foremost_offset), a("offset_along_face", offset_along_face), a("found_travel", found_travel),
      a("valid_travel", valid_travel);
  a("flat", flat), a("depth_range", depth_range), a("count_a", count[0]), a("count_b", count[1]);
}

/// Position of the common face along the normal, from the node, if the faces of the two sides are at `of_a` and `of_b`
/// [length]: that of a rigid side, else the middle.
inline double common_face_position(const ContactMember& a, const ContactMember& b, double of_a, double of_b) {
  if (a.inverse_mass == 0.0) return of_a;
  return b.inverse_mass == 0.0 ? of_b : 0.5 * (of_a + of_b);
}

/// Keeps faces while no particle moves more than a small part of a cell. Normals and areas stay as they were found;
/// gaps and face positions are computed in every step, from the few particles that can determine them.
///
/// A step either reuses the faces (reuse), or begins a new search (begin_search); faces that are found are stored
/// (store) until the search ends (end_search). Without a cache (`enabled` false) it only holds the faces of the step.
template <int Dim>
class FaceCache {
 public:
  /// `enabled`: faces may be kept from step to step; `planes`: those of the cloud.
  FaceCache(const System<Dim>& system, bool enabled, MirrorPlanes<Dim> planes = {})
      : system_(system), planes_(std::move(planes)), h_(system.lattice.spacing.maxCoeff()), enabled_(enabled) {}

  bool enabled() const { return enabled_; }
  /// Adds the largest distance that a particle may have moved in a step [cells].
  void add_travel(double cells) { travel_ += cells; }
  /// Forgets all faces.
  void clear() { steps_ = 0; }
  /// No face is kept from earlier steps.
  bool empty() const { return steps_ == 0; }
  /// All faces must be found anew in the next step: a particle has moved too far, or the faces are too old.
  bool is_expired() const;

  /// Gives the kept faces, with their present gaps, to the pairs of this step, and sets ContactNode::needs_faces where
  /// a face is no longer valid. False if faces must be found for all nodes: none is kept, all have expired, or some
  /// pair has no face yet. `bodies`: as in the cloud.
  bool reuse(ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies);
  /// Begins a search for the faces of all nodes (`all`, which forgets the old ones) or of those with needs_faces.
  void begin_search(ContactNodes<Dim>& contacts, bool all);
  /// The face of a pair (position in ContactNodes::pairs) that a search is to fill. Different pairs may be filled by
  /// different threads.
  ContactFace& new_face(std::size_t pair);
  /// The face of a pair.
  const ContactFace& face(std::size_t pair) const { return faces_[face_of_[pair]]; }
  /// Stores the particles that determine the gap of a face just found, or may do so while it is valid. `near`: the
  /// particles from which it was found.
  void store(ContactFace& face, NearParticles<Dim>& near) const;
  /// Stores how long it is known that a pair has no face. `apart`: see apart_beside_corner() [length].
  void store_missing(ContactFace& face, double apart) const;
  /// Ends a search: copies the stored particles from the cloud.
  void end_search(const ParticleCloud<Dim>& cloud);
  /// Whether the numbers of bodies and particles exist, as they do unless a checkpoint is damaged. `bodies`: as in the
  /// cloud.
  bool fits(const std::vector<Body<Dim>*>& bodies) const;
  /// Counts the steps for which faces are kept.
  void count_step() { steps_ = enabled_ ? steps_ + 1 : 0; }

  /// The kept faces, after a step; to be restored after ContactSearch::locate().
  friend void archive(Archive& a, FaceCache& cache) {
    a.version(2);
    a("steps", cache.steps_), a("travel", cache.travel_), a("compact_size", cache.compact_size_);
    if (cache.empty()) return;
    a.resizable("faces", cache.faces_);
    cache.archive_particles(a);
  }

 private:
  struct CachedParticle {
    ParticleLabel label;
    ParticleDomain<Dim> domain;  // present
  };

  void archive_particles(Archive& a);
  bool assign_faces(const ContactNodes<Dim>& contacts);
  bool update_pair(const ContactNode<Dim>& node, const ContactNodes<Dim>& contacts, ContactPair& pair,
                   const ContactFace& face) const;
  template <class F>
  void each_particle_number(bool just_found, F&& f);
  template <class F>
  void renumber(bool just_found, std::size_t count, F&& new_number);

  const System<Dim>& system_;
  MirrorPlanes<Dim> planes_;
  double h_;  // cell size [length]
  bool enabled_;
  std::vector<ContactFace> faces_;          // of the pairs at the time when all faces were found
  std::vector<std::size_t> face_of_;        // per pair of the step: its face
  std::vector<CachedParticle> particles_;   // that determine the faces
  std::vector<std::uint32_t> new_numbers_;  // scratch, see renumber
  std::vector<DomainReader<Dim>> domains_;  // scratch: of the bodies
  std::size_t compact_size_ = 0;            // number of particles when last each was needed by some face
  int steps_ = 0;                           // since all faces were found
  double travel_ = 0.0;                     // since then [cells]
};

}  // namespace tribo
