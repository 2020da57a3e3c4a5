// SPDX-License-Identifier: MIT
/// Search for the nodes at which velocity fields are in contact.
#pragma once

#include "solver/contact/contact_laws.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/exchange/exchange.hpp"

#include <span>
#include <tuple>
#include <vector>

namespace tribo {

/// Finds the grid nodes that carry two or more velocity fields, and lists their members and pairs.
///
/// Only nodes that the particles of two or more fields reach can carry these. Their blocks (shared blocks) are found
/// once per change of the maps (locate), the nodes in every step (find).
template <int Dim>
class ContactSearch {
 public:
  /// `laws`: of all pairs of fields; must outlive the search, as must `system`.
  ContactSearch(const System<Dim>& system, const ContactLaws<Dim>& laws) : system_(system), laws_(laws) {}

  /// Finds the shared blocks; to be called after every change of the fields' maps. Forgets all nodes, but keeps the
  /// impulses and velocities of the last momentum update for the next find().
  void locate();
  /// Finds the contact nodes from the present nodal masses. Pairs keep what ContactPair says of the last update. A node
  /// whose fields are all rigid is left out, as are pairs of two rigid fields and pairs of fields that differ by the
  /// side of two cracks. A pair across a crack gets the crack 0 and no law; Cracks then finds which crack it is.
  /// `exchanges`: one for each field.
  void find(const Exchanges<Dim>& exchanges);

  /// What was found.
  ContactNodes<Dim>& found() { return found_; }
  const ContactNodes<Dim>& found() const { return found_; }
  /// The contact node at an index of the lattice; null if there is none.
  const ContactNode<Dim>* node_at(const Index<Dim>& index) const;

  /// Before rank 0 saves a run of several processes: gives it the impulses of all of them.
  void collect() {
    if (!is_new_) kept_ = kept_pairs(), share_kept_pairs();
    is_collected_ = true;
  }
  void release() { is_collected_ = false; }

  friend void archive(Archive& a, ContactSearch& search) {
    a.version(5);
    if (!search.is_new_ && !search.is_collected_) search.kept_ = search.kept_pairs();
    if (a.reading()) search.is_new_ = true;
    archive_kept(a, search.kept_);
  }

 private:
  // What is kept of a pair until the next step.
  struct KeptPair {
    std::int64_t place;  // ContactNode::number
    std::int64_t a, b;   // fields
    ContactStatus status;
    Vec3 impulse, velocity;
    double mass;
    bool precedes(const KeptPair& other) const {
      return std::tie(place, a, b) < std::tie(other.place, other.a, other.b);
    }
  };

  static void archive_kept(Archive& a, std::vector<KeptPair>& kept);

  // A field that reaches nodes of a block.
  struct BlockUser {
    std::size_t field;
    int slot;               // of the block in the map of the field
    std::uint64_t reached;  // bits of the nodes
  };
  // A block with nodes that two or more fields reach.
  struct SharedBlock {
    std::int64_t block;   // in the lattice
    std::uint64_t nodes;  // bits of these nodes
    bool own;             // whether they count in the sums of this process
    std::vector<BlockUser> users;
  };

  // What is found at the blocks of a part that has changed; the ranges of nodes refer to these members and pairs.
  struct Fresh {
    std::vector<ContactNode<Dim>> nodes;
    std::vector<ContactMember> members;
    std::size_t pair_count = 0;
    std::vector<KeptPair> kept;  // of the pairs that the part had before
  };
  static constexpr std::size_t part_blocks = 64 / block_nodes<Dim>;

  template <class F>
  bool each_shared_node(std::size_t part, F&& f) const;
  bool list_members(const SharedBlock& shared, int local, std::vector<ContactMember>& members) const;
  bool update_part(std::size_t number);
  void renew_pair(ContactPair& pair) const;
  void list_nodes(const Exchanges<Dim>& exchanges, std::size_t number);
  bool can_touch(const ContactMember& a, const ContactMember& b) const;
  void place_nodes();
  bool place_parts();
  void fill_part(std::size_t number);
  void list_pairs(ContactNode<Dim>& node, std::span<const KeptPair> kept);
  KeptPair kept_pair(const ContactNode<Dim>& node, const ContactPair& pair) const;
  template <class Nodes>
  void add_kept(const Nodes& nodes, std::vector<KeptPair>& to) const;
  std::vector<KeptPair> kept_pairs() const;
  void share_kept_pairs();

  const System<Dim>& system_;
  const ContactLaws<Dim>& laws_;
  ContactNodes<Dim> found_;
  std::vector<SharedBlock> shared_;
  BlockTable<Dim, int> shared_at_{-1};  // per block: its position in shared_, or -1
  std::vector<KeptPair> kept_;          // in ascending order; those of the last step, from locate() to find()
  bool is_collected_ = false;           // kept_ has those of all processes
  bool is_new_ = true;                  // the shared blocks are others than in the last find()
  std::vector<Fresh> fresh_;            // scratch of find(): per part
  std::vector<ContactNode<Dim>> next_;  // scratch of find()
};

}  // namespace tribo
