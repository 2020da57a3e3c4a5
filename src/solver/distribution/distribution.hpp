// SPDX-License-Identifier: MIT
/// The particles of a run in several processes: which process has which, and the copies that others need.
#pragma once

#include "base/ranks.hpp"
#include "solver/state/system.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace tribo {

/// Each rank updates the particles in its own blocks. Of the particles in its ghost blocks it has copies, the ghosts,
/// which scatters include. With them the nodes that its own particles reach receive the contributions of the same bins
/// in the same order as in a single process, so that the results are the same to the last bit. The nodes further out
/// are incomplete, and nothing reads them.
///
/// In a single process, or while a rank computes alone, all functions do nothing. All ranks must call them together.
template <int Dim>
class Distribution {
 public:
  /// `layers`: of ghost blocks. Until the first call of exchange() or share_out(), every rank has all particles.
  Distribution(System<Dim>& system, int layers) : system_(system), layers_(layers) {}

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
  /// Copies the columns of the ghosts that change between sorts from the ranks to which their particles belong.
  void refresh_ghosts();

  /// Gives rank 0 all particles, as in a single process, until release(). Other ranks keep theirs.
  void collect();
  void release();

  /// Number of layers of ghost blocks.
  int layers() const { return layers_; }
  /// Imbalance of the present division: the largest number of particles of a rank over the mean.
  double imbalance() const { return imbalance_; }
  /// Bytes that this rank has sent in refresh_ghosts(), and the number of these calls.
  std::size_t bytes_sent() const { return bytes_sent_; }
  std::size_t refresh_count() const { return refresh_count_; }

 private:
  // The ranges of the bins of a body that a neighbour needs, and its ghosts that come from there.
  struct Shared {
    std::vector<Bin> sent;
    std::size_t first = 0, last = 0;
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
  void make_ghosts();
  void find_changing_columns();

  System<Dim>& system_;
  int layers_;
  bool shares_all_ = true;
  double imbalance_ = 1.0;
  std::size_t bytes_sent_ = 0, refresh_count_ = 0;
  std::int64_t divided_at_ = -1;                    // step of the last division
  std::vector<std::vector<Shared>> shared_;         // per neighbour and body
  std::vector<std::vector<std::size_t>> changing_;  // per body: numbers of the columns that change between sorts
  std::vector<Message> received_;
  std::vector<Kept> kept_;  // of rank 0, while it has all particles
};

}  // namespace tribo
