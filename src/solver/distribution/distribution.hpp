// SPDX-License-Identifier: MIT
/// The particles of a run in several processes: which process has which, and the copies that others need.
#pragma once

#include "base/ranks.hpp"
#include "solver/distribution/common_blocks.hpp"
#include "solver/distribution/ghost_columns.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace tribo {

/// Each rank updates the particles in its own blocks. Of the particles in its ghost blocks it has copies, the ghosts,
/// which scatters include. With them the nodes that its own particles reach receive the contributions of the same bins
/// in the same order as in a single process, so that the results are the same to the last bit. The nodes further out
/// are incomplete, and nothing reads them. The nodes of the common blocks (find_common_blocks()) are complete on every
/// rank.
///
/// In a single process, or while a rank computes alone, all functions do nothing. All ranks must call them together.
template <int Dim>
class Distribution {
 public:
  using ColumnChoice = std::function<std::vector<std::size_t>(Body<Dim>&)>;

  /// `layers`: of ghost blocks; `width`: number of nodes of a stencil along an axis. Until the first call of exchange()
  /// or share_out(), every rank has all particles.
  Distribution(const Model& model, System<Dim>& system, int layers, int width)
      : model_(model), system_(system), layers_(layers), width_(width) {}

  bool active() const { return ranks().count() > 1; }
  /// Whether every rank has all particles, as at the start and after a restart.
  bool shares_all() const { return active() && shares_all_; }
  /// From bins with all particles on every rank: divides the blocks by the numbers of their particles and keeps the
  /// particles of each rank.
  void share_out();
  /// To be called after the particles of each rank have been sorted into bins: moves those that are now in blocks of
  /// other ranks there, and makes the ghosts anew. If the numbers of particles of the ranks have become too unequal,
  /// the blocks are divided anew before.
  void exchange();
  /// Gives the ghosts the present values of their particles, in all columns that change between sorts.
  void refresh_ghosts();
  /// The same in the columns whose numbers columns(body) gives, unless more than scatters reads the ghosts of the
  /// model. `kind`: a number for this choice of columns, 0 or more.
  void refresh_ghosts(int kind, const ColumnChoice& columns);

  /// Gives every rank all particles, as at the start, until the next share_out() or exchange(). For what is seldom done
  /// and concerns all particles; each rank then does it alone.
  void unite();
  /// Gives rank 0 all particles, as in a single process, until release(). Other ranks keep theirs.
  void collect();
  void release();

  /// Number of layers of ghost blocks.
  int layers() const { return layers_; }
  /// Whether all nodes of a block are complete on every rank.
  bool is_common(const Index<Dim>& block) const {
    return std::binary_search(common_.begin(), common_.end(), system_.lattice.block_index(block));
  }
  /// Imbalance of the present division: the largest number of particles of a rank over the mean.
  double imbalance() const { return imbalance_; }
  /// What a rank has: particles, copies of those of others, and the ranks with which it exchanges values. What it has
  /// sent so far in refresh_ghosts(): bytes, and the number of these calls; how often the blocks have been divided.
  struct Counts {
    std::size_t particles = 0, ghosts = 0, partners = 0, bytes = 0, refreshes = 0, divisions = 0;
  };
  /// Those of all ranks at the last collect(), on rank 0.
  const std::vector<Counts>& counts() const { return counts_of_ranks_; }

 private:
  // Another rank that needs particles of this one, and the reverse: the own blocks that it needs in ascending order.
  struct Partner {
    int rank = 0;
    std::vector<std::int64_t> sent;
  };
  // The ranges of the bins of a body that a partner needs, and its ghosts that come from there.
  struct Shared {
    std::vector<Bin> sent;
    std::size_t first = 0, last = 0;
  };
  // The columns that are sent to refresh ghosts, per body, and room for what comes from the partners.
  struct Refresh {
    std::vector<std::vector<std::size_t>> columns;
    std::vector<Message> received;
  };
  struct Kept {
    Particles<Dim> particles;
    Bins<Dim> bins;
    std::vector<ContactOfParticle<Dim>> contacts;
  };

  std::vector<Body<Dim>*> bodies();
  void divide();
  void keep_own();
  bool move_leavers();
  void find_partners();
  std::vector<KnownBins<Dim>> known_bins();
  std::vector<BinContent<Dim>> contents_for(const Partner& partner, const Body<Dim>& body) const;
  void make_ghosts();
  void count();
  Refresh& refresh_of(int kind, const ColumnChoice& columns);
  void send(Refresh& refresh);
  std::vector<std::byte> own_particles();
  void place_all(std::span<const std::vector<std::byte>> of_ranks);

  const Model& model_;
  System<Dim>& system_;
  int layers_, width_;
  bool shares_all_ = true;
  double imbalance_ = 1.0;
  Counts counts_;
  std::vector<Counts> counts_of_ranks_;
  std::int64_t divided_at_ = -1;             // step of the last division
  std::vector<std::int64_t> common_;         // the common blocks in ascending order
  std::vector<Partner> partners_;            // in the order of their ranks
  std::vector<std::vector<Shared>> shared_;  // per partner and body
  std::map<int, Refresh> refreshes_;         // by kind; since the last sort
  std::vector<Kept> kept_;                   // of rank 0, while it has all particles
};

}  // namespace tribo
