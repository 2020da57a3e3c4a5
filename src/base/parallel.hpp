/// The only file that names OpenMP.
#pragma once

#include <omp.h>

#include <cstddef>
#include <exception>
#include <mutex>

namespace tribo {

/// Threads used by parallel_for from now on.
inline void set_threads(int count) { omp_set_num_threads(count > 0 ? count : 1); }
inline int threads() { return omp_get_max_threads(); }
inline int thread_index() { return omp_get_thread_num(); }

/// Calls f(i) for i in [0, n). Iterations must not touch each other's data, so the result does not depend on the number
/// of threads. Every thread gets one run of neighbouring indices, so that the same part of the domain stays in the same
/// core's cache from sweep to sweep. Exceptions of the lowest index that threw are passed on. Below `serial` items no
/// thread is started.
template <class F>
void parallel_for(std::ptrdiff_t n, F&& f, std::ptrdiff_t serial = 2) {
  if (n < serial || threads() == 1) {
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

}  // namespace tribo
