// SPDX-License-Identifier: MIT
/// Forces, works and areas of contact, summed over nodes.
#pragma once

#include "solver/contact/contact_nodes.hpp"
#include "solver/state/system.hpp"

#include <map>
#include <utility>
#include <vector>

namespace tribo {

/// What a pair of fields exchanges: works since the start of the run, and force and area in the last step.
struct PairLedger {
  Vec3 force = Vec3::Zero();  ///< on the field with the lower number, mean over the last step            [force]
  double friction = 0.0;      ///< work dissipated by sliding, >= 0 up to the accuracy of the scheme      [energy]
  double impact = 0.0;        ///< work of the normal impulses, dissipated                                [energy]
  double interface = 0.0;     ///< work done on imperfect interfaces                                      [energy]
  double stored = 0.0;        ///< the part of it that is stored in the interfaces now                    [energy]
  double area = 0.0;          ///< of the faces on which an impulse acted in the last step                [length^2]
};

inline void archive(Archive& a, PairLedger& pair) {
  auto& [force, friction, impact, interface, stored, area] = pair;
  a.version(1);
  a("force", force), a("friction", friction), a("impact", impact);
  a("interface", interface), a("stored", stored), a("area", area);
}

/// What a field of prescribed velocity received from all others in the last step, and the mass of the others at the
/// nodes where they touch it. Moments are about the origin of the coordinates.
struct RigidExchange {
  Vec3 impulse = Vec3::Zero();        ///< received                                             [mass velocity]
  Vec3 moment = Vec3::Zero();         ///< sum of x cross impulse                               [mass velocity length]
  Mat3 moment_tensor = Mat3::Zero();  ///< of blocks: sum of impulse x^T, x on the surface      [mass velocity length]
  double mass = 0.0;                  ///< of the other fields                                  [mass]
  double second_moment = 0.0;         ///< sum of m |x|^2                                       [mass length^2]
  Vec3 first_moment = Vec3::Zero();   ///< sum of m x                                           [mass length]
};

/// Records what contact does in each step.
template <int Dim>
class ContactLedger {
 public:
  /// Numbers of two fields, smaller first. The faces of crack c are recorded under (number of fields + c, number of
  /// fields).
  using Key = std::pair<std::size_t, std::size_t>;

  explicit ContactLedger(const System<Dim>& system) : system_(system) {}

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
  /// Sums of works and areas over all pairs; the force is left at zero.
  PairLedger total() const;
  /// Per field: what it received in the last step if its velocity is prescribed. Empty before the first record.
  const std::vector<RigidExchange>& rigid_exchanges() const { return rigid_exchanges_; }

  std::map<Key, PairLedger> pairs;    ///< by pair of fields
  double rigid_work = 0.0;            ///< done on deformable bodies by the motion of rigid ones so far  [energy]
  Vec3 rigid_impulse = Vec3::Zero();  ///< given to deformable bodies by rigid ones so far               [mass velocity]
  double nodal_work = 0.0;            ///< of contact, beyond that in velocities and accelerations       [energy]

  /// The exchanges with rigid bodies are those of the last step.
  friend void archive(Archive& a, ContactLedger& ledger) {
    auto& [its_pairs, its_work, its_impulse, its_nodal_work, system, rigid_exchanges] = ledger;
    a.version(2);
    a.map("pairs", its_pairs);
    a("rigid_work", its_work), a("rigid_impulse", its_impulse), a("nodal_work", its_nodal_work);
  }

 private:
  // The relative velocity of a pair at the start and end of the step.
  struct Relative {
    Vec3 start, end;
  };
  Key key(const ContactNodes<Dim>& contacts, const ContactPair& pair) const;
  double extrapolated(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, double dt) const;
  Relative relative(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, const ContactPair& pair,
                    double dt) const;
  void record_rigid(const ContactNodes<Dim>& contacts, const ContactNode<Dim>& node, const ContactPair& pair,
                    const Vec3& total, const Vec3& beyond);

  const System<Dim>& system_;
  std::vector<RigidExchange> rigid_exchanges_;
};

}  // namespace tribo
