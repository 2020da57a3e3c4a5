// SPDX-License-Identifier: MIT
/// Forces, works and areas of contact, summed over nodes.
#pragma once

#include "solver/contact/contact_nodes.hpp"
#include "solver/state/system.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace tribo {

/// What a pair of fields exchanges: works since the start of the run, impulse since the last row of the histories, and
/// force and area in the last step.
struct PairLedger {
  Vec3 force = Vec3::Zero();    ///< on the field with the lower number, mean over the last step            [force]
  double friction = 0.0;        ///< work dissipated by sliding, >= 0 up to the accuracy of the scheme      [energy]
  double impact = 0.0;          ///< work of the normal impulses, dissipated                                [energy]
  double interface = 0.0;       ///< work done on imperfect interfaces                                      [energy]
  double stored = 0.0;          ///< the part of it that is stored in the interfaces now                    [energy]
  double area = 0.0;            ///< of the faces on which an impulse acted in the last step                [length^2]
  Vec3 impulse = Vec3::Zero();  ///< of the force, since the last ContactLedger::start_means()          [force time]
};

inline void archive(Archive& a, PairLedger& pair) {
  auto& [force, friction, impact, interface, stored, area, impulse] = pair;
  a.version(2);
  a("force", force), a("friction", friction), a("impact", impact);
  a("interface", interface), a("stored", stored), a("area", area), a("impulse", impulse);
}

/// What a field of prescribed velocity received from all others in the last step, and the mass of the others at the
/// nodes where they touch it. Moments are about the origin of the coordinates, the inertia about the block's centre.
struct RigidExchange {
  Vec3 impulse = Vec3::Zero();        ///< received                                             [mass velocity]
  Vec3 moment = Vec3::Zero();         ///< sum of x cross impulse                               [mass velocity length]
  Mat3 moment_tensor = Mat3::Zero();  ///< of blocks: sum of impulse x^T, x on the surface      [mass velocity length]
  /// Of blocks: impulse and moment by which contact reacts to a unit change of the velocity and of the rotation of the
  /// block: sum of m G^T P G, G = (1, -[r]) the velocity at the node and P the directions that the law holds, all of
  /// them where the faces stick, and the normal one where they slide  [mass, mass length, mass length^2]
  Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Mean motion of a rigid block in a step: the mean of the velocities before and after each of its own steps.
struct BlockMean {
  Vec3 x = Vec3::Zero();  ///< centre at the start of the step              [length]
  Vec3 v = Vec3::Zero();  ///< of the centre                                [velocity]
  Vec3 w = Vec3::Zero();  ///< angular velocity                             [1/time]
};

/// Records what contact does in each step.
template <int Dim>
class ContactLedger {
 public:
  /// Numbers of two fields, smaller first. The faces of crack c are recorded under (number of fields + c, number of
  /// fields).
  using Key = std::pair<std::size_t, std::size_t>;

  explicit ContactLedger(const System<Dim>& system) : system_(system) {}

  /// For USAVG, before the strains at the start of a step: keeps the relative velocities of the pairs there. record()
  /// then takes the mean of these and those at the end. `strain_filtered`: see record_end().
  void keep_start(ContactNodes<Dim>& contacts, bool strain_filtered);
  /// Records the impulses of the corrector, and marks them in the pairs as those of the last update (update_impulse,
  /// update_status, friction_work). `dt`: step; `replaces`: the particles take over the nodal velocities in this step;
  /// `filtered`: FMPM, whose work is that at the velocities at the end of the step (NodalWork). `kept`: share of the
  /// impulses at the start of the step (ContactPair::at_start) that the particles take over.
  ///
  /// The work of an impulse is its product with the mean of the relative velocities at the start and end of the step.
  /// Where particles take over the nodal velocities, the extrapolation gives the faces a relative velocity at the
  /// start of every step that the bodies do not have: half a cell times the strain rate. The impulse removes it before
  /// anything is strained, so its work is that at the velocity at the end; the difference is a loss of the transfer.
  /// The filter of FMPM takes most of that impulse back.
  void record(ContactNodes<Dim>& contacts, double dt, bool replaces, bool filtered, double kept);
  /// For the "+" variants of the update, once the velocities have been extrapolated again and have passed contact: the
  /// particles are strained at these velocities, so that the impulses of the last record() do their work at them and
  /// not at those of the momentum update (as NodalWork::record_end()). `filtered`: as in record(); `strain_filtered`:
  /// the particles are strained with the filtered velocities (Field::filter).
  void record_end(ContactNodes<Dim>& contacts, bool filtered, bool strain_filtered);
  /// Completes the works of the impulses of the last record() on rigid blocks, once the blocks have moved. Contact sets
  /// nodes to the velocity of a block at the start of the step, but an impulse changes the velocity of the block, too:
  /// its work on the block is that at the mean velocity of the block in the step. This becomes the work on the
  /// deformable bodies, and the difference, J^2/(2 M) for an impulse J on a free block of mass M, is subtracted from
  /// what contact dissipates. `means`: motions of the blocks in the step, by number of the block.
  void record_block_motion(ContactNodes<Dim>& contacts, const std::vector<BlockMean>& means);
  /// Adds the forces of a step of size `dt` to the impulses, once contact and joints are recorded.
  void end_step(double dt);
  /// Starts a new interval of means: to be called when a row of the histories is written.
  void start_means();
  /// Mean force on the first field of a pair since the last start_means(): that of the histories. If no step has passed
  /// since then, the force of the last step  [force].
  Vec3 mean_force(const PairLedger& pair) const { return time > 0 ? Vec3(pair.impulse / time) : pair.force; }
  /// Sums of works and areas over all pairs; the force is left at zero.
  PairLedger total() const;
  /// Per field: what it received in the last step if its velocity is prescribed. Empty before the first record.
  const std::vector<RigidExchange>& rigid_exchanges() const { return rigid_exchanges_; }

  std::map<Key, PairLedger> pairs;    ///< by pair of fields
  double rigid_work = 0.0;            ///< done on deformable bodies by the motion of rigid ones so far  [energy]
  Vec3 rigid_impulse = Vec3::Zero();  ///< given to deformable bodies by rigid ones so far               [mass velocity]
  double nodal_work = 0.0;            ///< of contact, beyond that in velocities and accelerations       [energy]
  double time = 0.0;                  ///< since the last start_means()                                  [time]

  /// The exchanges with rigid bodies are those of the last step.
  friend void archive(Archive& a, ContactLedger& ledger) {
    auto& [its_pairs, its_work, its_impulse, its_nodal_work, its_time, system, rigid_exchanges, has_start, entries,
           node, last, last_key] = ledger;
    last = nullptr;
    a.version(3);
    a.map("pairs", its_pairs);
    a("rigid_work", its_work), a("rigid_impulse", its_impulse), a("nodal_work", its_nodal_work);
    a("time", its_time);
  }

 private:
  // The relative velocity of a pair at the start and end of the step.
  struct Relative {
    Vec3 start, end;
  };
  // What is added to a sum: to one of all contact, or to one of a pair.
  enum class Sum : std::int32_t { nodal_work, rigid_work, rigid_impulse, force, area, friction, impact, interface };
  struct Entry {
    std::int64_t node;  // ContactNode::number
    Sum sum;
    std::array<std::size_t, 2> pair;
    std::array<double, 3> value;  // a vector, or a number in its first component
  };
  void begin_node(const ContactNode<Dim>& node) { node_ = &node; }
  void book(Sum sum, const Key& pair, const Vec3& value);
  void book(Sum sum, const Key& pair, double value) { book(sum, pair, Vec3(value, 0, 0)); }
  void book(Sum sum, double value) { book(sum, {}, Vec3(value, 0, 0)); }
  void add(const Entry& entry);
  void add_booked();
  Key key(const ContactNodes<Dim>& contacts, const ContactPair& pair) const;
  Vec3 velocity_of(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, const ContactPair& pair, bool rigid,
                   bool strain_filtered) const;
  double extrapolated(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, double dt) const;
  // Work of the impulses of a pair [energy]: of all, and of their normal components.
  void add_work(const ContactNode<Dim>& node, ContactPair& pair, const Key& of, double all, double normal);
  // A rigid member of a pair: position and velocity at which the impulse of the pair acts on it.
  struct RigidPoint {
    Vec3 x, velocity;
  };
  RigidPoint rigid_point(const ContactNode<Dim>& node, const ContactPair& pair, const ContactMember& rigid,
                         double sign) const;
  Relative relative(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, const ContactPair& pair,
                    double dt) const;
  static void add_inertia(const ContactPair& pair, double mass, const Vec3& r, RigidExchange& to);
  void record_rigid(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, const ContactPair& pair,
                    const Vec3& total, const Vec3& beyond);

  const System<Dim>& system_;
  std::vector<RigidExchange> rigid_exchanges_;
  bool has_start_ = false;  // keep_start() was called in this step
  // In a run of several processes, what this one adds to the sums of rank 0, in the order of the nodes.
  std::vector<Entry> entries_;
  const ContactNode<Dim>* node_ = nullptr;  // that is being recorded
  PairLedger* last_ = nullptr;              // the pair to which something was added last
  Key last_key_;
};

}  // namespace tribo
