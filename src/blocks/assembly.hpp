// SPDX-License-Identifier: MIT
/// Rigid blocks and the contacts between them: the data, and one step of it.
///
/// Every quantity is a vector in space. In two dimensions the z components of positions and velocities are zero, and
/// blocks rotate about z only.
#pragma once

#include "base/aligned.hpp"
#include "base/archive.hpp"
#include "blocks/overlap.hpp"
#include "blocks/shape.hpp"
#include "blocks/shared_region.hpp"
#include "contact/joint_geometry.hpp"
#include "contact/joint_law.hpp"
#include "model/blocks.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace tribo {

/// Position x, velocity v, angular velocity w and rotation R of a block. Velocities belong to the middle of the last
/// step.
struct BlockMotion {
  Vec3 x = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero();
  Mat3 R = Mat3::Identity();
};
void archive(Archive& a, BlockMotion& motion);

/// Properties of a block that do not change.
struct BlockBody {
  double mass = 1.0;    ///< inertial mass; in quasi-static runs it is fitted to the step
  double weight = 0.0;  ///< density times volume
  double volume = 0.0;
  double stress_weight = 0.0;     ///< of its stress in means: its volume; 0 if not all forces on it are known
  Vec3 inertia = Vec3::Ones();    ///< about the principal axes
  Mat3 axes = Mat3::Identity();   ///< the principal axes, in body axes
  bool sphere = true;             ///< all three moments of inertia are equal (or two dimensions)
  Vec3 reference = Vec3::Zero();  ///< point that distances and stresses refer to, from the centre, in body axes
  Vec3 start = Vec3::Zero();      ///< centre at the start
  int held = 0;                   ///< bits 1 2 4: velocity along x y z, 8 16 32: rotation about x y z
  std::int32_t hold = -1;         ///< index of its prescribed motion: holds first, then platens
  std::int32_t group = -1;        ///< index into BlocksSpec::groups; -1: a platen
};

/// Forces and moments about the centre; `all` without the local damping.
struct BlockForces {
  Vec3 all = Vec3::Zero(), moment = Vec3::Zero();
  Vec3 outer = Vec3::Zero(), outer_moment = Vec3::Zero();  ///< the part of pressures and loads
  Vec3 damping = Vec3::Zero(), damping_moment = Vec3::Zero();
};
void archive(Archive& a, BlockForces& forces);

/// Action of the bodies in a grid on a block during a step; moment about the centre.
struct GridForce {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  Mat3 spread = Mat3::Zero();  ///< sum of force (position - centre)^T
};
void archive(Archive& a, GridForce& force);

/// Sums over time of work on one block [energy].
struct BlockWork {
  double outer = 0.0;     ///< done by pressures, loads and the grid
  double boundary = 0.0;  ///< done by prescribed motion
  double damped = 0.0;    ///< dissipated by local damping
  double stepping = 0.0;  ///< see BlockLedger
};
void archive(Archive& a, BlockWork& work);

/// How the geometry of a contact follows its bodies.
enum class ContactKind : std::uint8_t {
  facet,         ///< a pair of faces that moves with the blocks
  ball,          ///< between two balls
  ball_on_face,  ///< between a ball and the nearest point of a body with faces
  overlap        ///< a part of the intersection of two polygons or polyhedra, computed in every step
};

/// Normal springs of faces that an overlap replaces.
struct FormerFaces {
  double force = 0.0;   ///< in compression, >= 0
  double energy = 0.0;  ///< stored in these springs
};

struct BlockContact {
  std::uint32_t a = 0, b = 0;                   ///< ends 1 and 2
  Vec3 pa = Vec3::Zero(), pb = Vec3::Zero();    ///< the point on each face, from the centre, in body axes
  Vec3 na = Vec3::UnitX(), nb = Vec3::UnitX();  ///< normal from a to b as each sees it; of balls na[0], nb[0] radii
  JointAxes axes;
  double mass = 0.0;       ///< m_a m_b/(m_a + m_b)
  double on_a = 0.5;       ///< position between pa (1) and pb (0); the normal is weighted the other way round
  std::uint32_t part = 0;  ///< of an overlap: index of the part
  /// Of an overlap that replaces faces, until it is first computed.
  std::optional<FormerFaces> replaced = std::nullopt;
  double couple = 0.0;  ///< of an overlap: moment about the normal over the normal force [length]
  /// Of an overlap that replaced faces: a face, of those of a and then b, that counts as moved inwards by `set_back`.
  std::uint32_t face = 0;
  double set_back = 0.0;
};
void archive(Archive& a, BlockContact& contact);

/// Force and moment of a contact on b; the opposite acts on a.
struct ContactForce {
  Vec3 at = Vec3::Zero();
  Vec3 elastic = Vec3::Zero(), all = Vec3::Zero(), moment = Vec3::Zero();
};
void archive(Archive& a, ContactForce& force);

/// Contacts of one law and kind, contiguous in the arrays.
struct ContactGroup {
  const JointLaw* law = nullptr;
  ContactKind kind = ContactKind::facet;
  std::size_t begin = 0, end = 0;
  bool platen = false;
};

/// A face with pressure on it.
struct PressedFace {
  std::uint32_t body = 0;
  Vec3 p = Vec3::Zero(), n = Vec3::UnitX();  ///< position and outward normal in body axes
  double area = 0.0;
  std::uint32_t pressure = 0;  ///< index into BlocksSpec::pressures
};

/// The facet of a contact in the axes of body a, for output.
struct ContactOutline {
  std::vector<Vec3> corners;
};

struct BlockEvent {
  double time = 0.0;
  std::size_t contact = 0;
  Vec3 x = Vec3::Zero();
  JointEvent event;
};

/// Energies of the whole assembly [energy]. The content, kinetic + strain + potential + dissipated, grows by the work
/// done on it.
struct BlockLedger {
  double kinetic = 0.0, strain = 0.0, potential = 0.0;
  double slip = 0.0, dashpot = 0.0, damping = 0.0, released = 0.0;  ///< dissipated, >= 0
  double outer_work = 0.0, boundary_work = 0.0;                     ///< supplied
  /// The kinetic energy is m v- v+/2, of the velocities half a step before and after, which leapfrog keeps to
  /// round-off. Where the step changes, and at the start, it jumps by (h- - h+) F (v+ - v-)/4; this is the sum of the
  /// jumps.
  double stepping = 0.0;
  double content() const { return kinetic + strain + potential + slip + dashpot + damping + released - stepping; }
};
void archive(Archive& a, BlockLedger& ledger);

struct ContactFrame;

class Assembly {
 public:
  /// Builds blocks and contacts. `plane_stress` matters for the fictitious stress in two dimensions only. `max_step` is
  /// the step of quasi-static runs. Throws InputError.
  Assembly(std::shared_ptr<const BlocksSpec> spec, int dimension, bool plane_stress, const Vec3& gravity,
           double max_step);

  /// Largest stable step times BlocksSpec::step_share [time].
  double critical_step() const { return critical_step_; }
  /// The block whose contacts are the stiffest for its mass, which limits the step.
  std::size_t step_block() const { return step_block_; }
  /// One step of dt: velocities, positions, contacts, forces. Throws SimulationError.
  void advance(double dt);
  /// Computes the forces on all bodies anew, after a change of gravity, damping, pressures or joints. Contacts keep
  /// their forces, unless their bonds have changed.
  void renew_forces();
  /// Blocks, kind, place and normal of a contact of a group of this kind, for the criteria of rules.
  BlockPairing pairing_of(std::size_t contact, ContactKind kind) const;
  /// A contact at its present place, for JointLaw::adopt.
  JointSite site_of(std::size_t contact) const;
  /// The law of the contacts of a platen of this description; each assembly makes it anew.
  static std::shared_ptr<const JointLaw> law_of_platen(const BlocksSpec& spec, std::size_t platen);
  /// Index of the platen whose contacts follow a law; that of no platen: the number of platens.
  std::size_t platen_with(const JointLaw* law) const {
    const auto is = [law](const auto& own) { return own.get() == law; };
    return static_cast<std::size_t>(std::find_if(own_laws_.begin(), own_laws_.end(), is) - own_laws_.begin());
  }
  /// Events since the last call.
  std::vector<BlockEvent> take_events();

  bool plane() const { return plane_; }
  std::size_t block_count() const { return blocks_; }
  BlockLedger ledger() const;
  /// Mean stress of the blocks by volume.
  Mat3 mean_stress() const;
  /// Symmetric part of the displacement gradient that fits the displacements of the blocks best.
  Mat3 mean_strain() const;
  /// Rotation vector of a block since the start, of at most half a revolution.
  Vec3 rotation(std::size_t body) const;
  /// Force of the blocks on a platen.
  Vec3 platen_force(std::size_t platen) const;
  Vec3 platen_displacement(std::size_t platen) const;
  /// The point of a block's surface nearest to x.
  Vec3 nearest_on(std::size_t body, const Vec3& x) const;
  /// On a block, from contacts, pressures, loads and the grid.
  Vec3 contact_force(std::size_t body) const {
    const Vec3 all = forces[body].all - bodies[body].weight * gravity_;
    return grid_forces.empty() ? all : Vec3(all + grid_forces[body].force);
  }
  /// True if all positions and velocities are finite numbers.
  bool is_finite() const;
  /// Throws SimulationError if blocks overlap that have no contact, or carry a force across faces that slid past each
  /// other: without a law for new contacts none are detected. Also if blocks without a bond overlap by more than a
  /// third of the thinner one. Checks only after blocks have moved.
  void check_contacts();
  double platen_area(std::size_t platen) const { return platen_area_[platen]; }
  /// Largest force on a free block over the mean force of contacts; 1 if there is a force on a block, but none in
  /// contacts.
  double unbalanced() const;
  /// Cauchy stress of a block, by the forces on its faces; symmetric.
  Mat3 stress_of(std::size_t body) const;
  std::size_t bonds() const;
  /// Contacts that carry a force.
  std::size_t active() const;
  double bytes() const;

  /// All that changes with time.
  friend void archive(Archive& a, Assembly& blocks);
  /// Pairs of blocks that may touch, found since the start, each with the index of its law: law a b law a b ...
  std::vector<std::int64_t> found_pairs() const;

  // State; blocks come first, then platens
  AlignedVector<BlockMotion> motion;
  std::vector<std::array<double, 4>> orientation;  ///< quaternions w x y z
  std::vector<BlockBody> bodies;
  std::vector<BlockForces> forces;
  std::vector<BlockWork> work;
  std::vector<BlockShape> shapes;  ///< in body axes about the centre
  AlignedVector<BlockContact> contacts;
  AlignedVector<Joint> joints;
  AlignedVector<ContactForce> contact_forces;
  std::vector<double> dashpot_work;  ///< per contact, dissipated: positive
  std::vector<double> failure_mode;  ///< of the bond of a contact: 0 whole, 1 tension, 2 shear
  std::vector<Vec3> shift;           ///< of periodic boxes, per contact; else empty
  std::vector<ContactGroup> groups;
  std::vector<ContactOutline> outlines;
  std::vector<PressedFace> pressed;
  std::vector<GridForce> grid_forces;  ///< per body, constant until changed; empty without a grid
  std::vector<Mat3> stress;            ///< per body; of the last step if a law has Poisson's ratio
  Mat3 box_rate = Mat3::Zero();        ///< velocity gradient of a periodic box
  double time = 0.0;
  std::int64_t step = 0;
  std::array<std::int64_t, 2> broken{};  ///< bonds so far: in tension, in shear

  /// An assembly of the cells of a tessellation with one law, for tests and programs: bodies, contacts and stiffness,
  /// density 1 unless said otherwise.
  Assembly(const Tessellation& cells, std::span<const Vec3> nuclei, const std::shared_ptr<const JointLaw>& law,
           bool plane, bool plane_stress, double thickness, int stress_iterations);

 private:
  struct Batch {
    std::size_t group, begin, end;
  };
  static constexpr std::size_t batch_size = 128;
  /// Two blocks that may touch, found during the run, and the index of their law in later_laws_.
  struct FoundPair {
    std::uint32_t law, a, b;
    bool operator==(const FoundPair&) const = default;
    bool operator<(const FoundPair& o) const { return std::tie(law, a, b) < std::tie(o.law, o.a, o.b); }
  };

  // build.cpp
  std::size_t add_body(const BlockShape& shape, const Vec3& reference, double density);
  void add_facet(const BlockFacet& facet, const JointLaw& law, bool corners);
  void add_contact(const BlockContact& c, const JointSite& site, const JointLaw& law, ContactKind kind,
                   std::vector<Vec3> outline, const Vec3& shift);
  void refuse_overlaps(double tolerance) const;
  void add_platens(const std::vector<BlockFacet>& free);
  void add_pressures(const std::vector<BlockFacet>& free);
  void add_holds_and_loads();
  void finish(double max_step);
  void connect();

  // masses.cpp
  struct Stiffness {
    double straight = 0.0, turning = 0.0;
  };
  std::vector<Stiffness> stiffness_around() const;
  std::vector<Stiffness> viscosity_around(const std::vector<Stiffness>& stiffness) const;
  void expect_neighbours(std::vector<Stiffness>& around) const;
  void choose_masses(const std::vector<Stiffness>& around, double max_step, double nu);
  void set_step(const std::vector<Stiffness>& around, double max_step, double nu);
  double mass_between(std::uint32_t a, std::uint32_t b) const;

  // new_laws.cpp
  void list_later_laws();
  BlockPairing pairing(std::uint32_t a, std::uint32_t b, ContactKind kind, const Vec3& place, const Vec3& normal,
                       bool later) const;
  std::optional<std::uint32_t> later_law(std::uint32_t a, std::uint32_t b) const;

  // detect.cpp
  void join_balls(std::vector<bool>& used);
  void find_pairs(double dt);
  /// Springs of all faces of each pair of blocks that lose their permanent contacts.
  std::map<std::pair<std::uint32_t, std::uint32_t>, FormerFaces> release_moved_faces(double dt);
  void set_found_pairs(std::span<const std::int64_t> pairs);
  double later_reach() const;
  void set_pairs(const std::vector<FoundPair>& pairs,
                 const std::map<std::pair<std::uint32_t, std::uint32_t>, FormerFaces>& replaced = {});
  std::pair<BlockContact, JointSite> ball_contact(std::uint32_t a, std::uint32_t b) const;
  bool moved(std::span<const Vec3> since, double distance) const;
  void refuse_deep_overlaps() const;
  std::array<Vec3, 3> marks(std::size_t body) const;
  void store_marks(std::vector<Vec3>& places) const;
  std::vector<Bounds> bounds(double margin) const;
  JointAxes axes_between(std::uint32_t a, std::uint32_t b) const;
  double gap_between(std::uint32_t a, std::uint32_t b, double enough) const;

  // moving_contacts.cpp
  void place(std::size_t body, PlacedBlock& to) const;
  template <bool Plane>
  void move_contact(std::size_t contact, const ContactFrame& to, double dt, JointIncrement& d);
  void resize(Joint& joint, double area, const JointIncrement& d) const;
  /// The overlap of two blocks as their contacts see it, in working memory.
  struct OverlapNow {
    PlacedBlock a, b;
    BlockGap apart;
    SharedRegion region;
    bool found = false;
    double closed = 0.0;  ///< gap from which on they press
    std::uint32_t face = 0;
    double set_back = 0.0;
    std::array<SharedPart, 4> parts;
  };
  void find_overlap(OverlapNow& now) const;
  void set_back(OverlapNow& now, std::size_t face, double by) const;
  void follow_set_back(OverlapNow& now) const;
  void begin_as_faces(OverlapNow& now, const JointAxes& axes, const FormerFaces& faces, double stiffness) const;
  void place_overlap(std::size_t contact, double dt, OverlapNow& now) const;
  void overlap_increments(const Batch& batch, double dt, JointIncrement* to);
  void ball_on_face_increments(const Batch& batch, double dt, JointIncrement* to);

  // step.cpp
  void move_bodies(double dt);
  void update_contacts(const Batch& batch, double dt);
  void increments(const Batch& batch, double dt, JointIncrement* to);
  template <ContactKind Kind, bool Plane>
  void following_increments(const Batch& batch, double dt, JointIncrement* to);
  void apply_law(std::size_t batch, std::span<JointIncrement> d);
  void iterate_stress(double dt);
  void set_force(std::size_t contact);
  void sum_forces(std::size_t body, double dt);
  void apply_pressures();
  void update_stress(std::size_t body);
  Mat3 mean_stress_at(const BlockContact& c, double nu) const;

  std::shared_ptr<const BlocksSpec> spec_;
  bool plane_ = true, plane_stress_ = false, poisson_ = false;
  double thickness_ = 1.0, damping_ = 0.0, critical_step_ = 0.0;
  std::size_t step_block_ = 0;
  int iterations_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  std::size_t blocks_ = 0;
  std::vector<Batch> batches_;
  std::vector<std::vector<JointEvent>> batch_events_;
  std::vector<JointIncrement> kept_increments_;  // with iterations only
  std::vector<Vec3> predicted_;                  // with iterations only: elastic forces without the fictitious part
  std::vector<std::uint32_t> first_, entries_;   // per body: contacts it belongs to, 2 contact + end
  std::vector<std::uint32_t> first_pressed_, pressed_of_;
  std::vector<ContactForce> pressed_force_;  // per pressed face: `at` and `all`
  std::vector<double> pressure_now_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> loaded_;  // body, load; sorted by body
  struct ScatterTerms {
    std::array<const TimeFunction*, 6> of{};
    int held = 0;
  };
  std::vector<ScatterTerms> prescribed_motions_;  // of holds, then of platens
  std::vector<std::array<double, 6>> prescribed_now_;
  std::vector<std::shared_ptr<const JointLaw>> own_laws_;  // of platens
  std::vector<double> platen_area_;
  std::vector<BlockEvent> events_;
  std::vector<std::uint32_t> balls_;
  std::vector<std::vector<BlockEdge>> edges_;  // of every block in three dimensions; else empty
  std::vector<const JointLaw*> later_laws_;    // of contacts formed during the run, each once; empty: none may form
  std::size_t permanent_ = 0;                  // contacts that exist from the start; those detected later follow
  double skin_ = 0.0;                          // pairs of blocks closer than this have a contact
  std::vector<double> reach_;                  // of blocks from their centres
  std::vector<Vec3> found_at_, checked_at_;
  BlockLedger removed_;                        // of contacts that no longer exist
  double last_step_ = 0.0, time_error_ = 0.0;  // rounding error of `time`, for the compensated sum
};

/// A point as messages show it: (x, y), or (x, y, z) where z is not zero, with four significant digits.
std::string place_text(const Vec3& x);

}  // namespace tribo
