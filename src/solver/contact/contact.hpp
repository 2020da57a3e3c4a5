// SPDX-License-Identifier: MIT
/// Contact between velocity fields: where they meet, what their laws answer, and what it does to the nodes.
#pragma once

#include "base/stopwatch.hpp"
#include "contact/contact_law.hpp"
#include "solver/contact/face_geometry.hpp"
#include "solver/contact/face_solver.hpp"
#include "solver/contact/node_solver.hpp"
#include "solver/contact/particle_cloud.hpp"
#include "solver/cracks/cracks.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/joints/joints.hpp"
#include "solver/transfer/transfer.hpp"

#include <map>

namespace tribo {

/// What a pair of fields exchanged since the start of the run (works), or in the last step (force).
struct PairLedger {
  Vec3 force = Vec3::Zero();  ///< on the field with the lower number, mean over the last step    [force]
  double friction = 0.0;      ///< work dissipated by sliding, >= 0 up to the scheme's accuracy     [energy]
  double impact = 0.0;        ///< work of the normal impulses, dissipated                         [energy]
  double interface = 0.0;     ///< work put into imperfect interfaces                              [energy]
  double stored = 0.0;        ///< of it stored now                                                [energy]
  double area = 0.0;          ///< of the faces that touch now                                     [length^2]
};

inline void archive(Archive& a, PairLedger& pair) {
  auto& [force, friction, impact, interface, stored, area] = pair;
  a.version(1);
  a("force", force), a("friction", friction), a("impact", impact);
  a("interface", interface), a("stored", stored), a("area", area);
}

/// What a field of prescribed velocity got from all others in the last step, and what those weigh at the nodes where
/// they touch it. Moments about the origin of space.
struct RigidShare {
  Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();
  Mat3 spread = Mat3::Zero();       ///< of blocks: sum of impulse x^T, x on their surface
  double mass = 0.0, second = 0.0;  ///< sums of m and m |x|^2
  Vec3 first = Vec3::Zero();        ///< of m x
};

template <int Dim>
class Contact {
 public:
  /// When in the step the fields are brought together.
  enum class Pass {
    start,  ///< extrapolated velocities, before a strain update
    update  ///< after the momentum update: the impulse of the step
  };

  Contact(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, Cracks<Dim>& cracks);

  /// False with a single field: there is nothing to do.
  bool active() const { return active_; }
  /// FLIP and XPIC add accelerations, or filter velocities without them; they keep the velocities of the first pass, as
  /// a mismatch of extrapolated velocities must not turn into an acceleration. Transfers that reset the particle
  /// velocities use that pass for the strain only, and the impulse of the update is the whole impulse.
  bool keeps_start() const { return keeps_start_; }

  /// Finds the blocks that fields share; after every change of their maps.
  void locate();
  /// Finds the nodes where fields meet, normals, gaps and areas, from particles at the start of the step. Normals and
  /// areas are kept for as long as no particle moves more than a small part of a cell, those of flat faces longer; gaps
  /// are always new. Where joints act between two bodies their law does not.
  void find(const Exchanges<Dim>& exchanges, const Joints<Dim>& joints);
  /// Tells how far some particle may have moved in this step [cells].
  void moved(double cells) { moved_ += cells; }
  /// Forgets what is kept from step to step.
  void forget() { kept_steps_ = 0; }
  /// True if the next step starts from particles alone, so that a run may be interrupted here without a trace.
  bool interruptible() const { return !active_ || !keeps_faces_ || kept_steps_ == 0 || worn(); }
  /// Applies the laws to the present velocities.
  void meet(double dt, Pass pass);
  /// Takes the impulses of the first pass back.
  void part();
  /// Applies the laws to filter increments: the answer to all increments so far must follow the law.
  /// Nairn, arXiv:2604.07307 (2026).
  void refine(bool update);
  /// Books the impulses of the update, and lets the particles remember.
  void book(double dt);

  /// By numbers of fields, smaller first; what acts between the faces of cracks under numbers beyond.
  const std::map<std::pair<std::size_t, std::size_t>, PairLedger>& ledger() const { return ledger_; }
  std::map<std::pair<std::size_t, std::size_t>, PairLedger>& ledger() { return ledger_; }
  /// Calls f(pair, side a, side b, share of sums over nodes) for the pairs whose faces touch: a force acted in the last
  /// step, or the gap is next to nothing.
  template <class F>
  void each_touching(F&& f) const {
    static constexpr double nothing = 0.01;  // cells
    for (const ContactNode& node : nodes_)
      for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
        const ContactPair& pair = pairs_[p];
        if (pair.shown != ContactStatus::open || (!pair.apart && pair.state.gap < nothing * h_))
          f(pair, members_[pair.a], members_[pair.b], node.share);
      }
  }
  /// Sums over pairs.
  PairLedger total() const;
  /// Work done on the deformable bodies by the motion of rigid ones so far [energy].
  Stopwatch watch;  ///< of all that contact does in a step
  double rigid_work = 0.0;
  /// Momentum they gave to the deformable bodies so far.
  Vec3 rigid_impulse = Vec3::Zero();
  /// By field; empty without contact.
  const std::vector<RigidShare>& rigid_shares() const { return rigid_shares_; }
  /// Fills the particle columns that show contact: state (0 open, 1 stick, 2 slip), traction, normal.
  void show();
  std::size_t node_count() const { return nodes_.size(); }

  /// The sums over the run. What is kept from step to step is not saved: see interruptible().
  friend void archive(Archive& a, Contact& contact) {
    a.version(1);
    a.map("pairs", contact.ledger_);
    a("rigid_work", contact.rigid_work), a("rigid_impulse", contact.rigid_impulse);
  }

 private:
  struct ContactNode {
    Index<Dim> index;
    std::size_t first_member, end_member, first_pair, end_pair;
    double share;           // of sums over nodes
    int mirrored;           // bits: axes of symmetry planes through the node
    bool by_faces = false;  // solved by face_impulses_
    bool stale = true;      // its faces must be found
    bool bodies = false;    // some pair is of bodies, not of the faces of a crack
    std::int64_t number;    // among the nodes of shared blocks
  };
  struct SharedBlock {
    std::int64_t block;
    std::vector<std::pair<std::size_t, int>> slots;  // field, slot
  };
  // The faces of a pair as found some steps ago: its normal, and the particles that make the faces.
  struct Faces {
    static constexpr std::size_t most = 32;
    std::int64_t node = -1;  // number among the nodes of shared blocks
    std::size_t a = 0, b = 0;
    Vec3 normal = Vec3::Zero();
    double area = 0.0;
    double play = 0.0;    // added to the gap
    double beside = 0.0;  // how far along the face it is from the node to where both sides have it
    double found = 0.0;   // the travel when they were found [cells]
    bool apart = false, just_found = false;
    bool flat = false;               // however the node lies to them, as long as they do not turn
    double serves = 0.0;             // for so much travel [cells]
    std::array<double, 2> relief{};  // from the foremost to the hindmost of the particles
    std::array<std::size_t, 2> count{};
    std::array<std::array<std::uint32_t, most>, 2> corners{};  // in the cloud, later among the kept particles
  };
  using Groups = std::vector<const ParticleGroup<Dim>*>;
  // What is near a node, for a pair: both sides' particles by groups, and those of them that matter.
  struct Scratch {
    std::array<Groups, 2> groups;
    std::array<ParticleSet<Dim>, 2> sides;
    Vec<Dim> towards;  // from the first to the second
    bool wide;         // the normal is that of wide faces, not of corners
    std::vector<double> reach, bounds;
    std::array<double, 2> most;        // how far the foremost particles reach
    std::vector<std::size_t> numbers;  // of particles in the cloud
  };
  // The normal between the foremost particles; whether all particles would surely give the same, and the same gap.
  struct Front {
    std::optional<Vec<Dim>> normal;
    bool same_normal = false, same_gap = false;
  };
  // Gaps are measured from the particles at most this far sideways [cells].
  static constexpr double band = 0.75;
  // Smooth faces are round or hollow by at most this within the band: radii of five cells or more [cells].
  static constexpr double smooth = 0.06;
  // Particles this far behind the foremost may become it before the faces are found again [cells].
  static constexpr double kept_depth = 0.05;
  // Particles this far beyond the band may come into it before that [cells].
  static constexpr double most_beside = 0.2;

  const ContactLaw* law_of(std::size_t a, std::size_t b) const {
    return laws_[system_.fields[a].home * field_count_ + system_.fields[b].home];
  }
  // contact.cpp
  void list_nodes(const Exchanges<Dim>& exchanges);
  void list_pairs(ContactNode& node);
  void meet_cracks();
  void scatter_volumes(const Exchanges<Dim>& exchanges);
  std::span<ContactPair> pairs_of(const ContactNode& node) {
    return {pairs_.data() + node.first_pair, node.end_pair - node.first_pair};
  }

  std::pair<std::size_t, std::size_t> ledger_key(const ContactPair& pair) const {
    if (pair.crack >= 0) return {field_count_ + static_cast<std::size_t>(pair.crack), field_count_};
    return {system_.fields[members_[pair.a].field].home, system_.fields[members_[pair.b].field].home};
  }

  // contact_kept.cpp
  bool worn() const;
  bool reuse_faces();
  bool reuse(const ContactNode& node, ContactPair& pair, const Faces& face) const;
  void find_faces(const Exchanges<Dim>& exchanges, bool all);
  void collect();
  void keep(Faces& kept, Scratch& s, const Vec<Dim>& n) const;
  void number_kept();
  void leave_to_joints(const Joints<Dim>& joints);
  void gather_faces();

  // contact_faces.cpp
  void face(const ContactNode& node, ContactPair& pair, Faces& kept, Scratch& scratch);
  double face_between(const ContactPair& pair, double of_a, double of_b) const;
  double area(const ContactNode& node, const ContactPair& pair, Scratch& s, const Vec<Dim>& n) const;
  bool is_thin(const ContactNode& node, Scratch& s, std::size_t side, const Vec<Dim>& out) const;
  double separation(const ContactNode& node, const ContactPair& pair, Scratch& scratch, const Vec<Dim>& n) const;
  double beside(Scratch& scratch, const Vec<Dim>& n) const;
  Vec3 opening(const ContactNode& node, Scratch& scratch, const Vec<Dim>& n) const;
  void recall(const ContactNode& node, ContactPair& pair, const Scratch& scratch) const;
  double weight(const Vec<Dim>& distance) const;
  template <class F>
  void each_point_of(const Groups& groups, const Vec<Dim>& centre, F&& f) const {
    for (const auto* group : groups)
      cloud_.each_point(*group, centre, [&](std::uint32_t k) { f(cloud_.point(k), cloud_.label(k)); });
  }

  // contact_normals.cpp
  Vec<Dim> gradient_normal(const ContactMember& a, const ContactMember& b) const;
  void look_around(const ContactNode& node, Scratch& s, const ContactMember& a, const ContactMember& b) const;
  void fill_sides(const Vec<Dim>& centre, Scratch& s) const;
  void add_beside(const Vec<Dim>& centre, Scratch& s, const Vec<Dim>& n) const;
  static std::size_t keep_ahead(Scratch& s, std::size_t begin, std::size_t end, double limit);
  void take_front(const Vec<Dim>& centre, Scratch& s, std::size_t side, const Vec<Dim>& out) const;
  bool has_all(const Vec<Dim>& centre, Scratch& s, std::size_t side, const Vec<Dim>& guess, const Vec<Dim>& out,
               double limit) const;
  Front margin_of_front(const Vec<Dim>& centre, Scratch& s, const Vec<Dim>& guess) const;
  std::optional<Vec<Dim>> chosen_normal(const ContactNode& node, Scratch& s, const ContactMember& a,
                                        const ContactMember& b) const;

  // contact_impulses.cpp
  void remember();
  void book_rigid(const ContactNode& node, const ContactPair& pair);
  template <class F>
  void each_pair_near(const ParticleDomain<Dim>& p, std::size_t field, F&& f) const;

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  Cracks<Dim>& cracks_;
  bool active_ = false, keeps_start_ = false, remembers_ = false, interfaces_ = false;
  bool needs_areas_ = false;  ///< or gradients, whenever faces are found
  std::size_t field_count_ = 0;
  std::vector<const ContactLaw*> laws_;
  std::vector<Body<Dim>*> bodies_;
  std::vector<DomainReader<Dim>> domains_;  ///< scratch: of the bodies
  ParticleCloud<Dim> cloud_;
  FaceSolver<Dim> face_solver_;
  std::vector<SharedBlock> shared_;
  std::vector<char> near_;  ///< per lattice block: 1 where volumes are wanted
  std::vector<ContactNode> nodes_;
  std::vector<ContactMember> members_;
  std::vector<ContactPair> pairs_;
  std::vector<Faces> faces_;          ///< of the pairs at the time when all faces were found
  std::vector<std::size_t> face_of_;  ///< per pair: which of faces_
  struct Kept {
    ParticleLabel label;
    ParticleDomain<Dim> point;  // now
  };
  std::vector<Kept> kept_;                  ///< the particles that make the faces
  std::vector<std::uint32_t> kept_number_;  ///< scratch: per point of the cloud, among the kept
  std::size_t needed_ = 0;                  ///< how many there were when last all were needed
  bool keeps_faces_ = false;
  int kept_steps_ = 0;          ///< steps since the faces were found; 0: none are kept
  double moved_ = 0.0;          ///< since then [cells]
  std::vector<int> record_;     ///< per shared block and node: number of the meeting node, or -1
  std::vector<int> shared_at_;  ///< per lattice block: number of the shared block, or -1
  std::vector<Scratch> scratch_;
  std::map<std::pair<std::size_t, std::size_t>, PairLedger> ledger_;
  std::vector<RigidShare> rigid_shares_;
  double h_ = 0.0;
};

}  // namespace tribo
