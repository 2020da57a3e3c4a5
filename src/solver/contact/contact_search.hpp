// SPDX-License-Identifier: MIT
/// Search for the nodes at which velocity fields are in contact.
#pragma once

#include "solver/contact/contact_laws.hpp"
#include "solver/contact/contact_nodes.hpp"
#include "solver/exchange/exchange.hpp"

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

  /// Finds the shared blocks; to be called after every change of the fields' maps. Forgets all nodes.
  void locate();
  /// Finds the contact nodes from the present nodal masses. A node whose fields are all rigid is left out, as are pairs
  /// of two rigid fields and pairs of fields that differ by the side of two cracks. A pair across a crack gets the
  /// crack 0 and no law; Cracks then finds which crack it is. `exchanges`: one for each field.
  void find(const Exchanges<Dim>& exchanges);

  /// Keeps the impulses and velocities of a momentum update for the next find().
  void remember_pairs();

  /// What was found.
  ContactNodes<Dim>& found() { return found_; }
  const ContactNodes<Dim>& found() const { return found_; }
  /// The contact node at an index of the lattice; null if there is none.
  const ContactNode<Dim>* node_at(const Index<Dim>& index) const;

  friend void archive(Archive& a, ContactSearch& search) {
    a.version(5);
    std::vector<std::int64_t> numbers;
    std::vector<double> impulses, velocities, masses;
    for (const KeptPair& pair : search.kept_) {
      numbers.insert(numbers.end(), {pair.place, pair.a, pair.b, static_cast<std::int64_t>(pair.status)});
      impulses.insert(impulses.end(), pair.impulse.begin(), pair.impulse.end());
      velocities.insert(velocities.end(), pair.velocity.begin(), pair.velocity.end());
      masses.push_back(pair.mass);
    }
    a.resizable("pairs", numbers), a.resizable("impulses", impulses), a.resizable("velocities", velocities);
    a.resizable("masses", masses);
    search.kept_.resize(numbers.size() / 4);
    if (numbers.size() != 4 * search.kept_.size() || impulses.size() != 3 * search.kept_.size() ||
        velocities.size() != impulses.size() || masses.size() != search.kept_.size())
      refuse_checkpoint("the pairs of contact and their impulses differ in number");
    for (std::size_t k = 0; k < search.kept_.size(); ++k) {
      const std::int64_t* n = numbers.data() + 4 * k;
      search.kept_[k] = {n[0],
                         n[1],
                         n[2],
                         static_cast<ContactStatus>(n[3]),
                         Eigen::Map<const Vec3>(impulses.data() + 3 * k),
                         Eigen::Map<const Vec3>(velocities.data() + 3 * k),
                         masses[k]};
    }
  }

 private:
  // What is kept of a pair until the next step.
  struct KeptPair {
    std::int64_t place;  // position of the node among those of all blocks of the lattice
    std::int64_t a, b;   // fields
    ContactStatus status;
    Vec3 impulse, velocity;
    double mass;
    bool precedes(const KeptPair& other) const {
      return std::tie(place, a, b) < std::tie(other.place, other.a, other.b);
    }
  };

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
    std::vector<BlockUser> users;
  };

  // What is found at some shared blocks; the ranges of nodes refer to these members.
  struct Chunk {
    std::vector<ContactNode<Dim>> nodes;
    std::vector<ContactMember> members;
    std::size_t pair_count = 0;
    std::size_t first_node = 0, first_member = 0, first_pair = 0;  // in the lists of all
  };
  static constexpr std::size_t chunk_blocks = 16;

  void list_nodes(const Exchanges<Dim>& exchanges, std::size_t number);
  bool list_members(const SharedBlock& shared, int local, ContactNode<Dim>& node,
                    std::vector<ContactMember>& members) const;
  bool can_touch(const ContactMember& a, const ContactMember& b) const;
  void list_pairs(ContactNode<Dim>& node, std::int64_t place);
  std::int64_t place_of(std::int64_t number) const;

  const System<Dim>& system_;
  const ContactLaws<Dim>& laws_;
  ContactNodes<Dim> found_;
  std::vector<SharedBlock> shared_;
  std::vector<int> shared_at_;            // per block of the lattice: its position in shared_, or -1
  std::vector<KeptPair> kept_;            // in ascending order
  std::vector<Chunk> chunks_;             // scratch of find()
  std::vector<std::size_t> kept_before_;  // scratch of remember_pairs(): per range of nodes
  std::vector<int> node_of_;              // per shared block and node: its position in found_.nodes, or -1
};

}  // namespace tribo
