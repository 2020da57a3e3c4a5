// SPDX-License-Identifier: MIT
/// Parallel loops. This is the only file that uses OpenMP.
#pragma once

#include <omp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

namespace tribo {

/// Sets the number of threads of parallel_for.
inline void set_threads(int count) { omp_set_num_threads(count > 0 ? count : 1); }
inline int threads() { return omp_get_max_threads(); }
inline int thread_index() { return omp_get_thread_num(); }
/// Whether the caller runs in an iteration of a loop on several threads. Loops in it run on its thread.
inline bool inside_parallel_loop() { return omp_in_parallel() != 0; }

/// Calls f(i) for i in [0, n). Iterations must not access each other's data, so the result does not depend on the
/// number of threads. Every thread gets one range of consecutive indices, so that the same part of the domain stays in
/// the cache of the same core from loop to loop. If iterations throw, the exception of the lowest index is rethrown.
/// Loops with fewer than `serial` iterations run on one thread.
template <class F>
void parallel_for(std::ptrdiff_t n, F&& f, std::ptrdiff_t serial = 2) {
  if (n < serial || threads() == 1 || inside_parallel_loop()) {
    for (std::ptrdiff_t i = 0; i < n; ++i) f(i);
    return;
  }
  std::exception_ptr first;
  std::ptrdiff_t first_index = n;
  std::mutex guard;
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    try {
      f(i);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (i < first_index) first_index = i, first = std::current_exception();
    }
  }
  if (first) std::rethrow_exception(first);
}

/// Parallel loop over items of unequal weight. `before(i)`, ascending, is the total weight of the items before the
/// i-th; before(n) is that of all items. Every thread starts with a range of consecutive items of about the same
/// weight. Threads that have finished take over items of others, which balances cores that are temporarily slower.
template <class Before, class F>
void parallel_for_weighted(std::ptrdiff_t n, Before&& before, F&& f) {
  static constexpr std::ptrdiff_t most_parts = 256;
  const std::ptrdiff_t parts = std::min<std::ptrdiff_t>(threads(), most_parts);
  if (parts < 2 || inside_parallel_loop()) return parallel_for(n, f);
  const auto from = [&](std::ptrdiff_t part) {
    const double weight = static_cast<double>(before(n)) * static_cast<double>(part) / static_cast<double>(parts);
    std::ptrdiff_t low = 0, high = n;  // bisection for the first item whose midpoint lies at or beyond that weight
    while (low < high) {
      const std::ptrdiff_t i = (low + high) / 2;
      if (0.5 * (static_cast<double>(before(i)) + static_cast<double>(before(i + 1))) < weight)
        low = i + 1;
      else
        high = i;
    }
    return low;
  };
  struct alignas(64) Part {
    std::atomic<std::ptrdiff_t> next;
    std::ptrdiff_t end;
  };
  std::array<Part, most_parts> part;
  for (std::ptrdiff_t k = 0; k < parts; ++k) {
    part[static_cast<std::size_t>(k)].next = k == 0 ? 0 : from(k);
    part[static_cast<std::size_t>(k)].end = k + 1 == parts ? n : from(k + 1);
  }
  parallel_for(parts, [&](std::ptrdiff_t mine) {
    for (std::ptrdiff_t k = 0; k < parts; ++k) {
      Part& p = part[static_cast<std::size_t>((mine + k) % parts)];
      for (std::ptrdiff_t i = p.next++; i < p.end; i = p.next++) f(i);
    }
  });
}

}  // namespace tribo
