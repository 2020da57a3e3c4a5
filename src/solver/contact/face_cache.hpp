// SPDX-License-Identifier: MIT
/// Contact faces that are kept from step to step.
#pragma once

#include "base/archive.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/contact/near_particles.hpp"
#include "solver/contact/reach_rows.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace tribo {

/// The common face of a pair as it was last found from the particles, and the particles that determine its gap.
struct ContactFace {
  static constexpr std::size_t max_particles = 32;  ///< per side; a face with more is not cached
  static constexpr double not_found = -1.0;         ///< valid_travel of a face that was never found

  std::int64_t node = -1;       ///< ContactNode::number
  std::size_t a = 0, b = 0;     ///< fields
  bool missing = false;         ///< the pair has no common face at this node
  Vec3 normal = Vec3::Zero();   ///< unit normal from a to b
  double area = 0.0;            ///< share of the node in the contact area                             [length^2]
  double gap_correction = 0.0;  ///< added to the gap between the foremost particles, see gap_correction()  [length]
  Vec3 foremost_offset = Vec3::Zero();  ///< see ContactPair::foremost_offset
  double offset_along_face = 0.0;  ///< distance along the face from the node to the nearest particles at it   [length]

  bool just_found = false;               ///< in this step
  bool apart = false;                    ///< ContactPair::apart in the last step
  bool has_approached = false;           ///< no longer, and its gap must be measured
  std::int64_t found_step = 0;           ///< number of the step in which it was found, see FaceCache
  std::array<double, 2> found_travel{};  ///< per side: travel of the field when it was found                   [cells]
  double valid_travel = not_found;       ///< it is valid while neither side travels farther                    [cells]
  bool flat = false;                     ///< both sides are plane, so it looks the same from everywhere until it turns
  double measured_gap = 0.0;  ///< when it was last computed from the particles                            [length]
  std::array<double, 2> measured_travel{};  ///< per side: travel of the field then                       [cells]
  std::array<double, 2> depth_range{};      ///< per side: largest minus smallest reach of the particles    [length]
  std::array<std::size_t, 2> count{};       ///< per side: number of particles; may exceed max_particles
  /// The particles of the first side, then those of the second: numbers in the cloud while just_found, later numbers in
  /// the list of cached particles.
  std::vector<std::uint32_t> particles;

  /// Number of particles in the list of a side.
  std::size_t listed(std::size_t side) const { return std::min(count[side], max_particles); }
  /// The particles of a side.
  std::span<const std::uint32_t> particles_of(std::size_t side) const {
    return std::span(particles).subspan(side == 0 ? 0 : listed(0), listed(side));
  }
  /// Forgets what was found, except for the pair and the time.
  void begin() { particles.clear(), count = {}, missing = flat = false; }
  /// Faces are in ascending order of their nodes and fields, as are the pairs of a step.
  std::tuple<std::int64_t, std::size_t, std::size_t> key() const { return {node, a, b}; }
};

/// Saves and restores a face. The numbers of its particles are saved by FaceCache.
inline void archive(Archive& a, ContactFace& face) {
  auto& [node, field_a, field_b, missing, normal, area, gap_correction, foremost_offset, offset_along_face, just_found,
         apart, has_approached, found_step, found_travel, valid_travel, flat, measured_gap, measured_travel,
         depth_range, count, particles] = face;
  a.version(4);
  a("node", node), a("a", field_a), a("b", field_b), a("missing", missing);
  a("normal", normal), a("area", area), a("gap_correction", gap_correction);
  a("foremost_offset", foremost_offset), a("offset_along_face", offset_along_face), a("found_step", found_step);
  a("found_travel_a", found_travel[0]), a("found_travel_b", found_travel[1]), a("valid_travel", valid_travel);
  a("measured_gap", measured_gap), a("measured_travel_a", measured_travel[0]);
  a("measured_travel_b", measured_travel[1]);
  a("flat", flat), a("depth_range", depth_range), a("count_a", count[0]), a("count_b", count[1]);
}

/// Position of the common face along the normal, from the node, if the faces of the two sides are at `of_a` and `of_b`
/// [length]: that of a rigid side, else the middle.
inline double common_face_position(const ContactMember& a, const ContactMember& b, double of_a, double of_b) {
  if (a.inverse_mass == 0.0) return of_a;
  return b.inverse_mass == 0.0 ? of_b : 0.5 * (of_a + of_b);
}

/// Keeps each face while no particle of its two fields moves more than a small part of a cell. Normals and areas stay
/// as they were found; gaps and face positions are computed in every step, from the few particles that can determine
/// them.
///
/// In every step reuse() gives the kept faces to the pairs and lists the pairs whose faces must be found. If there are
/// any, the faces that are found are stored (store) until the search ends (end_search). Without a cache (`enabled`
/// false) all faces are found in every step.
template <int Dim>
class FaceCache {
 public:
  /// `enabled`: faces may be kept from step to step; `planes`: those of the cloud.
  FaceCache(const System<Dim>& system, bool enabled, MirrorPlanes<Dim> planes = {})
      : system_(system), planes_(std::move(planes)), h_(system.lattice.spacing.maxCoeff()), enabled_(enabled) {}

  bool enabled() const { return enabled_; }
  /// Adds the largest distance that a particle of each field moved in a step [cells].
  void add_travel(const std::vector<double>& of_fields);
  /// Forgets all faces.
  void clear() {
    faces_.clear(), live_.clear(), particles_.clear(), needed_.clear();
    is_compact_ = true, compact_size_ = 0;
  }

  /// Gives the kept faces, with their present gaps, to the pairs of this step, and sets ContactPair::needs_face and
  /// ContactNode::needs_faces where a pair has no face yet or its face is no longer valid. True if there are such
  /// pairs. `bodies`: as in the cloud.
  bool reuse(ContactNodes<Dim>& contacts, const std::vector<Body<Dim>*>& bodies);
  /// The face of a pair (position in ContactNodes::pairs) that a search is to fill. Different pairs may be filled by
  /// different threads.
  ContactFace& new_face(std::size_t pair);
  /// The face of a pair.
  const ContactFace& face(std::size_t pair) const { return faces_[pair]; }
  /// Stores how long a face just found is valid, and the particles that determine its gap or may do so meanwhile.
  /// `pair`: that of the face, with its present gap; `near`: the particles from which it was found.
  void store(ContactFace& face, ContactPair& pair, NearParticles<Dim>& near) const;
  /// Stores how long it is known that a pair has no face. `apart`: see apart_beside_corner() [length].
  void store_missing(ContactFace& face, double apart) const;
  /// Ends a search: copies the stored particles from the cloud.
  void end_search(const ParticleCloud<Dim>& cloud);
  /// Whether the numbers of bodies and particles exist, as they do unless a checkpoint is damaged. `bodies`: as in the
  /// cloud.
  bool fits(const std::vector<Body<Dim>*>& bodies) const;

  /// The faces, with particles that are given by their bins, for other processes or another division of the particles.
  /// `own_only`: those at the own nodes of this process.
  std::vector<std::byte> portable_faces(const std::vector<Body<Dim>*>& bodies, bool own_only);
  /// Replaces the faces by those of such lists; faces at particles that are not here are omitted. The former faces are
  /// given back by return_faces().
  void take_faces(const std::vector<std::vector<std::byte>>& lists, const std::vector<Body<Dim>*>& bodies);
  void return_faces();
  void forget_former() { former_.reset(); }

  /// The kept faces, after a step; to be restored after ContactSearch::locate().
  friend void archive(Archive& a, FaceCache& cache) {
    a.version(5);
    if (!cache.enabled_) return;
    a("step", cache.step_), a.resizable("travel", cache.travel_), a.resizable("last_travel", cache.last_travel_);
    cache.archive_faces(a);
  }

 private:
  struct CachedParticle {
    ParticleLabel label;
    ReachRows<Dim> domain;  // present, if it is needed (needed_)
  };

  // What is known of a face at the beginning of a step: nothing, all but its gap, or all that matters.
  enum class Kept { nothing, normal, all };

  struct Range {
    std::size_t first, count;
  };

  std::vector<ContactFace*> live_faces();
  void archive_faces(Archive& a);
  void archive_particles(Archive& a, const std::vector<ContactFace*>& faces);
  void number_particles(const std::vector<ContactFace*>& faces, const std::vector<ParticleLabel>& labels);
  void assign_faces(const ContactNodes<Dim>& contacts);
  void assign_faces(const ContactNodes<Dim>& contacts, std::size_t number, std::vector<ContactFace>& to);
  void renew_with_others(ContactNodes<Dim>& contacts);
  bool has_spent(const ContactFace& face, double part) const;
  void keep_longer(ContactFace& face, double apart) const;
  double travel_of(std::size_t field) const { return travel_[system_.fields[field].base_field]; }
  void reuse_faces(ContactNode<Dim>& node, ContactNodes<Dim>& contacts);
  void measure_approached(ContactNode<Dim>& node, ContactNodes<Dim>& contacts);
  Kept reuse_face(ContactPair& pair, ContactFace& face) const;
  void find_domains(const std::vector<Body<Dim>*>& bodies);
  void find_domain(CachedParticle& particle) const;
  bool measure_gap(const ContactNode<Dim>& node, const ContactNodes<Dim>& contacts, ContactPair& pair,
                   ContactFace& face) const;
  void keep_gap(ContactFace& face, const ContactPair& pair) const;
  double least_gap(const ContactFace& face) const;
  bool stays_apart(const ContactFace& face, const ContactPair& pair) const;
  template <class F>
  void each_particle_number(bool just_found, F&& f);
  template <class F>
  void renumber(bool just_found, std::size_t count, F&& new_number);

  const System<Dim>& system_;
  MirrorPlanes<Dim> planes_;
  double h_;  // cell size [length]
  bool enabled_;
  std::vector<ContactFace> faces_, next_;   // per pair of the step: its face; scratch, see assign_faces
  std::vector<Range> live_;                 // per part of the contact nodes: the faces of its pairs
  bool is_compact_ = true;                  // faces_ has these faces only, without their parts (live_)
  std::vector<std::uint8_t> needed_;        // per particle: 1 if some of its faces is not apart
  std::vector<CachedParticle> particles_;   // that determine the faces
  std::vector<std::uint32_t> new_numbers_;  // scratch, see renumber
  std::vector<DomainReader<Dim>> domains_;  // scratch: of the bodies
  struct Lists {
    std::vector<ContactFace> faces;
    std::vector<Range> live;
    std::vector<CachedParticle> particles;
    std::vector<std::uint8_t> needed;
    bool is_compact;
    std::size_t compact_size;
  };
  std::optional<Lists> former_;       // see take_faces
  std::vector<std::int64_t> counts_;  // scratch, see renew_with_others
  std::size_t compact_size_ = 0;      // number of particles when last each was needed by some face
  std::int64_t step_ = 0;             // counts the steps
  std::vector<double> travel_;        // per field: since the beginning [cells]
  std::vector<double> last_travel_;   // per field: of the last step [cells]
};

}  // namespace tribo
