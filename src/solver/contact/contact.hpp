// SPDX-License-Identifier: MIT
/// Contact between velocity fields.
#pragma once

#include "base/stopwatch.hpp"
#include "solver/contact/contact_ledger.hpp"
#include "solver/contact/contact_memory.hpp"
#include "solver/contact/face_finder.hpp"
#include "solver/contact/face_solver.hpp"
#include "solver/contact/nodal_volumes.hpp"
#include "solver/contact/node_impulses.hpp"
#include "solver/cracks/cracks.hpp"
#include "solver/joints/joints.hpp"

namespace tribo {

/// Coordinates what contact does in a step.
///
/// ContactSearch finds the nodes that carry two or more fields. FaceFinder finds normals, gaps and areas there from the
/// particles, or FaceCache gives those of earlier steps. NodeImpulses and FaceSolver apply the contact laws to the
/// nodal velocities. ContactLedger records forces and works, ContactMemory what the particles keep.
template <int Dim>
class Contact {
 public:
  using Pass = ContactPass;

  /// All arguments must outlive the object.
  Contact(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, Cracks<Dim>& cracks);
  Contact(const Contact&) = delete;  // the parts refer to each other
  Contact& operator=(const Contact&) = delete;

  /// False if there is only one field; then all other functions do nothing.
  bool active() const { return active_; }
  /// Whether the velocity changes of the predictor stay in the nodal velocities during the momentum update. FLIP and
  /// XPIC add accelerations to particle velocities, or filter velocities without the accelerations: the mismatch of
  /// extrapolated velocities that the predictor removes must not enter the acceleration, so they keep its changes.
  /// Transfers that replace the particle velocities use the predictor for strains only, and the corrector gives the
  /// whole impulse of the step.
  bool keeps_start_impulses() const { return keeps_start_impulses_; }
  /// How contact acts on the velocities from which the strains follow. The particle velocities of XPIC take over the
  /// changes of the predictor.
  Pass start_pass() const { return start_pass_; }

  /// Finds the blocks that fields share; to be called after every change of the fields' maps.
  void locate();
  /// Finds the contact nodes and their faces, from the particles at the start of the step. `exchanges`: one for each
  /// field. A contact law does not act where one of `joints` acts between the same two bodies.
  void find(const Exchanges<Dim>& exchanges, const Joints<Dim>& joints);
  /// Adds the largest distance that a particle of each field moved in this step [cells].
  void add_travel(const std::vector<double>& of_fields) { cache_.add_travel(of_fields); }
  /// Forgets the faces that are kept from step to step.
  void forget_faces() { cache_.clear(); }
  /// Applies the contact laws to the present nodal velocities, in the corrector also to the accelerations. `dt`: step.
  void apply(double dt, Pass pass);
  /// Subtracts the velocity changes of the predictor.
  void remove_start_impulses();
  /// Applies the contact laws to the increments of a velocity filter (Field::filter): the impulses must obey the laws
  /// for the sum of all increments so far. Nairn, arXiv:2604.07307 (2026). `pass`: that of the apply() before.
  void constrain_increments(Pass pass);
  /// Keeps the relative velocities that strain the bodies at the start of a step, see ContactLedger::keep_start().
  void keep_start(bool strain_filtered);
  /// Records the impulses of the corrector in the ledger, and updates slip and bonds of particles and cracks. `dt`:
  /// step; `flip`: FLIP fraction of the update of the particles; `filtered`: see ContactLedger::record().
  void record(double dt, double flip, bool filtered);
  /// Completes the works of the "+" variants of the update, see ContactLedger::record_end().
  void record_end(bool filtered, bool strain_filtered);
  /// Completes the works on rigid blocks, see ContactLedger::record_block_motion().
  void record_block_motion(const std::vector<BlockMean>& means) {
    if (active_ && !means.empty()) ledger_.record_block_motion(search_.found(), means);
  }

  ContactLedger<Dim>& ledger() { return ledger_; }
  const ContactLedger<Dim>& ledger() const { return ledger_; }
  /// All contact nodes of the step.
  const std::vector<ContactNode<Dim>>& nodes() const { return search_.found().nodes; }
  /// Calls f(pair, member a, member b) for the pairs of a node whose faces are closed: an impulse acted in the last
  /// step, or the gap is less than 0.01 cells.
  template <class F>
  void each_closed_pair(const ContactNode<Dim>& node, F&& f) const {
    static constexpr double closed = 0.01;  // cells
    const ContactNodes<Dim>& contacts = search_.found();
    for (const ContactPair& pair : contacts.pairs_of(node))
      if (pair.update_status != ContactStatus::open || (!pair.has_no_face && pair.state.gap < closed * h_))
        f(pair, contacts.members[pair.a], contacts.members[pair.b]);
  }
  /// Fills the particle columns that show contact, see fill_contact_view.
  void fill_view();

  /// In a run of several processes, before rank 0 saves its state: collects the faces of all processes there, in two
  /// parts, before and after it has received all particles. release() gives its own ones back.
  void collect_faces();
  void place_collected_faces();
  void release() { cache_.return_faces(), search_.release(), has_all_particles_ = false; }
  /// Rank 0 has all particles, whose contact has been found before.
  void keep_view() { has_all_particles_ = true; }
  /// Before and after the particles of a run that was restored are divided among processes.
  void pack_faces();
  void unpack_faces();

  Stopwatch watch;  ///< time spent in contact

  /// The faces that are kept from step to step. They are saved apart from the rest, since locate() forgets them.
  void archive_kept(Archive& a);
  /// The sums over the run, and the pairs that stick.
  friend void archive(Archive& a, Contact& contact) {
    a.version(2);
    a("ledger", contact.ledger_), a("search", contact.search_);
  }

 private:
  void find_crack_faces();
  void find_faces(const Exchanges<Dim>& exchanges);
  void collect_particles();
  void leave_to_joints(const Joints<Dim>& joints);

  const Model& model_;
  System<Dim>& system_;
  Cracks<Dim>& cracks_;
  ContactLaws<Dim> laws_;
  bool active_, keeps_start_impulses_;
  Pass start_pass_;
  std::vector<Body<Dim>*> bodies_;  // those with a field: deformable, then rigid
  MirrorPlanes<Dim> planes_;
  ParticleCloud<Dim> cloud_;  // particles around the contact nodes whose faces are found in this step
  ContactSearch<Dim> search_;
  NodalVolumes<Dim> volumes_;
  FaceFinder<Dim> finder_;
  FaceCache<Dim> cache_;
  NodeImpulses<Dim> node_impulses_;
  FaceSolver<Dim> face_solver_;
  ContactMemory<Dim> memory_;
  ContactLedger<Dim> ledger_;
  std::vector<NearParticles<Dim>> near_;  // working memory, one for each thread
  std::vector<std::size_t> searched_;     // scratch: contact nodes whose faces are found in this step
  bool has_all_particles_ = false;
  std::vector<std::vector<std::byte>> collected_;  // faces of all processes
  double h_;                                       // cell size [length]
};

}  // namespace tribo
