// SPDX-License-Identifier: MIT
/// Arrays aligned to cache lines. Large ones use huge pages where the system has them.
#pragma once

#include "base/parallel.hpp"

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace tribo {

template <class T>
struct CacheAligned {
  using value_type = T;
  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}  // NOLINT(google-explicit-constructor)
  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < page / 2) return static_cast<T*>(::operator new (bytes, std::align_val_t{64}));
    const std::size_t whole = bytes < page ? page : bytes;
    void* p = ::operator new (whole, std::align_val_t{page});
    madvise(p, whole, MADV_HUGEPAGE);  // a hint that reduces misses of the address translation cache
    if (whole >= shared * page) touch(static_cast<char*>(p), whole);
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) {
    ::operator delete (p, std::align_val_t{n * sizeof(T) < page / 2 ? 64 : page});
  }
  template <class U>
  bool operator==(const CacheAligned<U>&) const {
    return true;
  }

 private:
  // The system clears a page when it is first written to, which takes longer than all that is written later. Here all
  // threads share this work.
  static void touch(char* p, std::size_t bytes) {
    parallel_for(static_cast<std::ptrdiff_t>(bytes / page),
                 [p](std::ptrdiff_t k) { *static_cast<volatile char*>(p + page * static_cast<std::size_t>(k)) = 0; });
  }

  static constexpr std::size_t shared = 4;  // pages
  static constexpr std::size_t page = std::size_t{1} << 21;
};

template <class T>
using AlignedVector = std::vector<T, CacheAligned<T>>;

}  // namespace tribo
