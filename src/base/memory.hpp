// SPDX-License-Identifier: MIT
/// Errors that say what the memory was too small for.
#pragma once

#include "base/error.hpp"

#include <new>
#include <stdexcept>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tribo {

/// Gives memory that was freed back to the system. The allocator of glibc keeps it otherwise.
inline void return_freed_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

/// From now on, gives arrays of more bytes than `size` back to the system as soon as they are freed, and of smaller
/// ones all but `kept` bytes at the end of the memory.
inline void return_arrays_above([[maybe_unused]] int size, [[maybe_unused]] int kept) {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, size);
  ::mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

/// Throws the error that there is not enough memory for `what`: an InputError at its place in the command file, or a
/// FileError if it has none.
[[noreturn]] inline void refuse_memory(const std::string& what, const Origin& origin = {}) {
  if (origin.file) throw InputError(origin, "not enough memory for " + what);
  throw FileError("not enough memory for " + what);
}

/// Calls `make` and returns what it does; if the memory is too small, refuse_memory(what, origin). The innermost call
/// tells its `what`.
template <class Make>
decltype(auto) with_memory_for(const std::string& what, const Origin& origin, Make&& make) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    refuse_memory(what, origin);
  } catch (const std::length_error&) {  // more than any memory has
    refuse_memory(what, origin);
  }
}
template <class Make>
decltype(auto) with_memory_for(const std::string& what, Make&& make) {
  return with_memory_for(what, Origin{}, std::forward<Make>(make));
}

}  // namespace tribo
