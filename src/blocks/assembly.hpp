// SPDX-License-Identifier: MIT
/// Rigid blocks and the contacts between them: the data, and one step of it.
///
/// Every quantity is a vector in space; in two dimensions z components of places and velocities are zero and only the
/// rotation about z lives.
#pragma once

#include "base/aligned.hpp"
#include "blocks/overlap.hpp"
#include "blocks/shape.hpp"
#include "contact/joint_geometry.hpp"
#include "contact/joint_law.hpp"
#include "model/blocks.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tribo {

/// What contacts need of a block. Velocities belong to the middle of the last step.
struct BlockMotion {
  Vec3 x = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero();
  Mat3 R = Mat3::Identity();
};

/// What does not change.
struct BlockBody {
  double mass = 1.0;    ///< inertia against motion; of quasi-static runs a chosen one
  double weight = 0.0;  ///< density times volume
  double volume = 0.0;
  double share = 0.0;             ///< weight of its stress in means: its volume; 0 where forces on it are unknown
  Vec3 inertia = Vec3::Ones();    ///< about the principal axes
  Mat3 axes = Mat3::Identity();   ///< these, in body axes
  bool sphere = true;             ///< all three are equal (or two dimensions)
  Vec3 reference = Vec3::Zero();  ///< point that distances and stresses refer to, from the centre, in body axes
  Vec3 start = Vec3::Zero();      ///< centre at the start
  int held = 0;                   ///< bits 1 2 4: velocity along x y z, 8 16 32: rotation about x y z
  std::int32_t hold = -1;         ///< which prescribed motion; the platens' come after the holds
  std::int32_t group = -1;        ///< of the description; -1: a platen
};

/// Forces and moments about the centre; `all` without the local damping.
struct BlockForces {
  Vec3 all = Vec3::Zero(), moment = Vec3::Zero();
  Vec3 outer = Vec3::Zero(), outer_moment = Vec3::Zero();  ///< the part of pressures and loads
  Vec3 damping = Vec3::Zero(), damping_moment = Vec3::Zero();
};

/// What the matter in a grid does to a block during a step; moment about the centre.
struct BlockPush {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  Mat3 spread = Mat3::Zero();  ///< sum of force (place - centre)^T
};

/// Sums over time of work on one block [energy].
struct BlockWork {
  double outer = 0.0;     ///< done by pressures, loads and pushes
  double boundary = 0.0;  ///< by what prescribes its motion
  double damped = 0.0;    ///< taken out by local damping
  double stepping = 0.0;  ///< see BlockLedger
};

/// How a contact follows its bodies.
enum class ContactKind : std::uint8_t {
  facet,   ///< a pair of faces that moves with the blocks
  ball,    ///< between two balls
  beside,  ///< between a ball and a body with faces, at whatever point of these is nearest
  overlap  ///< a part of what two polygons or polyhedra share, found anew in every step
};

struct BlockContact {
  std::uint32_t a = 0, b = 0;                   ///< ends 1 and 2
  Vec3 pa = Vec3::Zero(), pb = Vec3::Zero();    ///< the point on each face, from the centre, in body axes
  Vec3 na = Vec3::UnitX(), nb = Vec3::UnitX();  ///< normal from a to b as each sees it; of balls na[0], nb[0] radii
  JointAxes axes;
  double mass = 0.0;       ///< m_a m_b/(m_a + m_b)
  double on_a = 0.5;       ///< where it is between its points: 1 at that of a, 0 of b; its normal is then the other's
  std::uint32_t part = 0;  ///< of an overlap: which part
};

/// What a contact gives to its bodies: on b, the opposite on a.
struct ContactForce {
  Vec3 at = Vec3::Zero();
  Vec3 elastic = Vec3::Zero(), all = Vec3::Zero(), moment = Vec3::Zero();
};

/// Contacts of one law and kind, neighbours in the arrays.
struct ContactGroup {
  const JointLaw* law = nullptr;
  ContactKind kind = ContactKind::facet;
  std::size_t begin = 0, end = 0;
  bool platen = false;
};

/// A face with pressure on it.
struct PressedFace {
  std::uint32_t body = 0;
  Vec3 p = Vec3::Zero(), n = Vec3::UnitX();  ///< place and outward normal in body axes
  double area = 0.0;
  std::uint32_t pressure = 0;  ///< of the description
};

/// Where a contact is drawn: its facet in the axes of body a.
struct ContactOutline {
  std::vector<Vec3> corners;
};

struct BlockEvent {
  double time = 0.0;
  std::size_t contact = 0;
  Vec3 x = Vec3::Zero();
  JointEvent event;
};

/// Energies of the whole [energy]. content = kinetic + strain + potential + what was lost; it grows by work done.
struct BlockLedger {
  double kinetic = 0.0, strain = 0.0, potential = 0.0;
  double slip = 0.0, dashpot = 0.0, damping = 0.0, released = 0.0;  ///< lost, positive
  double outer_work = 0.0, boundary_work = 0.0;                     ///< put in
  /// The kinetic energy is m v- v+/2, of the velocities half a step before and after, which leapfrog keeps to
  /// round-off. Where the step changes, and at the start, it jumps by (h- - h+) F (v+ - v-)/4; this is the sum of the
  /// jumps.
  double stepping = 0.0;
  double content() const { return kinetic + strain + potential + slip + dashpot + damping + released - stepping; }
};

class Assembly {
 public:
  /// Builds blocks and contacts. `plane_stress` matters for the fictitious stress in two dimensions only. `max_step` is
  /// the step of quasi-static runs. Throws InputError.
  Assembly(std::shared_ptr<const BlocksSpec> spec, int dimension, bool plane_stress, const Vec3& gravity,
           double max_step);

  /// Largest stable step times the share that the description asks for.
  double critical_step() const { return critical_step_; }
  /// One step: velocities, places, contacts, forces.
  void advance(double dt);
  /// Events since the last call.
  std::vector<BlockEvent> take_events();

  bool plane() const { return plane_; }
  std::size_t block_count() const { return blocks_; }
  BlockLedger ledger() const;
  /// Mean stress of the blocks by volume.
  Mat3 mean_stress() const;
  /// Symmetric part of the displacement gradient that fits the blocks' displacements best.
  Mat3 mean_strain() const;
  /// Rotation vector of a block since the start, of at most half a turn.
  Vec3 turned(std::size_t body) const;
  /// Force of the blocks on a platen.
  Vec3 platen_force(std::size_t platen) const;
  Vec3 platen_displacement(std::size_t platen) const;
  /// The point of a block's surface nearest to x.
  Vec3 nearest_on(std::size_t body, const Vec3& x) const;
  /// On a block, from contacts, pressures, loads and pushes.
  Vec3 contact_force(std::size_t body) const {
    const Vec3 all = forces[body].all - bodies[body].weight * gravity_;
    return pushes.empty() ? all : Vec3(all + pushes[body].force);
  }
  /// All places and velocities are numbers.
  bool sound() const;
  /// Throws SimulationError if blocks press into one another that have no contact, or carry a force across faces that
  /// slid past each other: without a law for blocks that meet contacts are not found anew. Looks only if blocks moved.
  void check_contacts();
  double platen_area(std::size_t platen) const { return platen_area_[platen]; }
  /// Largest force on a free block over the mean force of contacts.
  double unbalanced() const;
  /// Cauchy stress of a block, by the forces on its faces; symmetric.
  Mat3 stress_of(std::size_t body) const;
  std::size_t bonds() const;
  /// Contacts that carry a force.
  std::size_t active() const;
  double bytes() const;

  /// Calls f(name, vector of numbers) for all that changes with time; what f writes into it goes back.
  using Column = std::function<void(const char* name, std::vector<double>& numbers)>;
  void each_column(const Column& f);
  /// Pairs of blocks that may touch, found since the start, a b a b ...; set them before the columns when a state is
  /// restored.
  std::vector<std::int64_t> found_pairs() const;
  void set_found_pairs(std::span<const std::int64_t> pairs);

  // State; blocks come first, then platens
  AlignedVector<BlockMotion> motion;
  std::vector<std::array<double, 4>> turn;  ///< quaternions w x y z
  std::vector<BlockBody> bodies;
  std::vector<BlockForces> forces;
  std::vector<BlockWork> work;
  std::vector<BlockShape> shapes;  ///< in body axes about the centre
  AlignedVector<BlockContact> contacts;
  AlignedVector<Joint> joints;
  AlignedVector<ContactForce> given;
  std::vector<double> dashpot_work;  ///< per contact, positive: lost
  std::vector<double> broke;         ///< how a contact's bond broke: 0 not, 1 in tension, 2 in shear
  std::vector<Vec3> shift;           ///< of periodic boxes, per contact; else empty
  std::vector<ContactGroup> groups;
  std::vector<ContactOutline> outlines;
  std::vector<PressedFace> pressed;
  std::vector<BlockPush> pushes;  ///< per body, constant until changed; or empty
  std::vector<Mat3> stress;       ///< per body; of the last step if a law has Poisson's ratio
  Mat3 box_rate = Mat3::Zero();   ///< velocity gradient of a periodic box
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
  void expect_neighbours(std::vector<Stiffness>& around) const;
  void choose_masses(const std::vector<Stiffness>& around, double max_step, double nu);
  void set_step(const std::vector<Stiffness>& around, double max_step, double nu);
  double mass_between(std::uint32_t a, std::uint32_t b) const;

  // detect.cpp
  void join_balls();
  void find_pairs(double dt);
  void retire_faces(double dt);
  void take_pairs(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);
  std::pair<BlockContact, JointSite> ball_contact(std::uint32_t a, std::uint32_t b) const;
  bool moved(std::span<const Vec3> since, double distance) const;
  std::array<Vec3, 3> marks(std::size_t body) const;
  void remember(std::vector<Vec3>& places) const;
  std::vector<Bounds> bounds(double margin) const;
  JointAxes axes_between(std::uint32_t a, std::uint32_t b) const;
  double gap_between(std::uint32_t a, std::uint32_t b, double enough) const;

  // meeting.cpp
  void place(std::size_t body, PlacedBlock& to) const;
  template <bool Plane>
  void move_contact(std::size_t contact, const Vec3& n, const Vec3& at, double dt, JointIncrement& d);
  void resize(Joint& joint, double area, const JointIncrement& d) const;
  void overlap_increments(const Batch& batch, double dt, JointIncrement* to);
  void beside_increments(const Batch& batch, double dt, JointIncrement* to);

  // step.cpp
  void move_bodies(double dt);
  void meet(const Batch& batch, double dt);
  void increments(const Batch& batch, double dt, JointIncrement* to);
  template <ContactKind Kind, bool Plane>
  void follow_all(const Batch& batch, double dt, JointIncrement* to);
  void apply_law(std::size_t batch, std::span<JointIncrement> d);
  void iterate_stress(double dt);
  void give(std::size_t contact);
  void gather(std::size_t body, double dt);
  void press();
  void update_stress(std::size_t body);
  Mat3 mean_stress_at(const BlockContact& c, double nu) const;

  std::shared_ptr<const BlocksSpec> spec_;
  bool plane_ = true, plane_stress_ = false, poisson_ = false;
  double thickness_ = 1.0, damping_ = 0.0, critical_step_ = 0.0;
  int iterations_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  std::size_t blocks_ = 0;
  std::vector<Batch> batches_;
  std::vector<std::vector<JointEvent>> batch_events_;
  std::vector<JointIncrement> kept_increments_;  // with iterations only
  std::vector<Vec3> predicted_;                  // the same: elastic forces without the fictitious part
  std::vector<std::uint32_t> first_, entries_;   // per body: contacts it belongs to, 2 contact + end
  std::vector<std::uint32_t> first_pressed_, pressed_of_;
  std::vector<ContactForce> pressed_force_;  // per pressed face: `at` and `all`
  std::vector<double> pressure_now_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> loaded_;  // body, load; sorted by body
  struct ScatterTerms {
    std::array<const TimeFunction*, 6> of{};
    int held = 0;
  };
  std::vector<ScatterTerms> given_motions_;  // of holds, then of platens
  std::vector<std::array<double, 6>> given_now_;
  std::vector<std::shared_ptr<const JointLaw>> own_laws_;  // of platens
  std::vector<double> platen_area_;
  std::vector<BlockEvent> events_;
  std::vector<std::uint32_t> balls_;
  std::vector<std::vector<BlockEdge>> edges_;  // of every block in three dimensions; else empty
  std::size_t lasting_ = 0;                    // contacts from the start on; those found later follow
  double skin_ = 0.0;                          // pairs of blocks nearer than this are contacts
  std::vector<double> reach_;                  // of blocks from their centres
  std::vector<Vec3> found_at_, checked_at_;
  BlockLedger gone_;                          // of contacts that are no more
  double last_step_ = 0.0, time_rest_ = 0.0;  // what rounding left out of `time`
};

}  // namespace tribo
