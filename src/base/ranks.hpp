// SPDX-License-Identifier: MIT
/// The processes that compute one run together.
#pragma once

#include "base/exact_sum.hpp"
#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tribo {

/// Data for another process, or from it.
struct Message {
  int rank = 0;  ///< the other process
  std::vector<std::byte> data;
};

/// Communication between the processes of a run, which are numbered by their rank. All ranks must call a function
/// together. The class itself is that of a run in a single process.
class Ranks {
 public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int rank() const { return 0; }
  virtual int count() const { return 1; }
  /// Replaces each number by its sum over all ranks.
  virtual void add(std::span<std::int64_t>) const {}
  /// Replaces each number by the largest one of all ranks.
  virtual void largest(std::span<double>) const {}
  /// Sends a message to each of its receivers, and returns what others sent to this rank, in the order of their ranks.
  virtual std::vector<Message> exchange(std::span<const Message>) const { return {}; }
  /// The same if each rank knows the sizes of what it receives: `received` holds messages of these sizes.
  virtual void exchange(std::span<const Message>, std::span<Message> received) const;
  /// Rank 0 receives the data of all ranks, in their order; other ranks receive nothing.
  virtual std::vector<std::vector<std::byte>> gather(std::vector<std::byte> data) const { return {std::move(data)}; }
  /// All ranks receive the data of rank 0.
  virtual void broadcast(std::vector<std::byte>&) const {}
};

/// The ranks of this run: a single one, unless others were given.
const Ranks& ranks();
/// Sets the ranks of this run, or, with null, a single one. The object must outlive all uses.
void set_ranks(const Ranks* all);

/// While it lives, this process computes alone: sums over ranks are its own.
class AloneScope {
 public:
  AloneScope();
  ~AloneScope() { set_ranks(before_); }
  AloneScope(const AloneScope&) = delete;
  AloneScope& operator=(const AloneScope&) = delete;

 private:
  const Ranks* before_;
};

/// Adds the sums of all ranks.
void add_over_ranks(std::span<ExactSum> sums);
/// The largest value of all ranks.
double largest_of_ranks(double value);
/// Whether the condition holds on some rank.
bool any_rank(bool condition);

/// Sums of several quantities that depend neither on the order of the terms nor on the ranks that add them.
template <int count>
class OrderlessSums {
 public:
  using Values = Eigen::Matrix<double, count, 1>;

  void add(const Values& terms) {
    for (int k = 0; k < count; ++k) sums_[static_cast<std::size_t>(k)].add(terms[k]);
  }
  void add(double term) requires(count == 1) { sums_[0].add(term); }
  /// The sums over all ranks; to be called once.
  Values total() {
    add_over_ranks(sums_);
    Values out;
    for (int k = 0; k < count; ++k) out[k] = sums_[static_cast<std::size_t>(k)].value();
    return out;
  }

 private:
  std::array<ExactSum, count> sums_;
};

/// The same for a number of quantities that is known at run time.
class SumList {
 public:
  /// Begins sums of so many quantities.
  void start(std::size_t count) { sums_.assign(count, {}); }
  void add(std::size_t quantity, double term) { sums_[quantity].add(term); }
  /// Adds the sums of another list of as many quantities.
  void add(const SumList& other) {
    for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k].add(other.sums_[k]);
  }
  /// Adds the sums of all ranks; to be called before they are read.
  void finish() { add_over_ranks(sums_); }
  double operator[](std::size_t quantity) const { return sums_[quantity].value(); }

 private:
  std::vector<ExactSum> sums_;
};

}  // namespace tribo
