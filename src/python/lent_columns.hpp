// SPDX-License-Identifier: MIT
/// Particle columns as arrays of Python, without copies.
#pragma once

#include "base/aligned.hpp"
#include "python/bindings.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace tribo::python {

/// Lends the memory of columns to arrays. Before the simulation goes on, take_back() leaves the memory to those arrays
/// that are still in use, and gives the simulation a copy. So an array is never copied as long as the simulation
/// stands, keeps its numbers for good, and never refers to memory that has gone.
class LentColumns {
 public:
  /// An array of the first `count` numbers of a column, which lies in the memory of `owner`.
  py::array lend(AlignedVector<double>& column, std::size_t count, bool writable, const std::shared_ptr<void>& owner);
  /// To be called, with the interpreter held, before the columns change. Returns whether the memory of a column moved.
  bool take_back();

 private:
  // What an array refers to: memory of the simulation, which it keeps alive, and then its own.
  struct Memory {
    AlignedVector<double>* column = nullptr;
    std::shared_ptr<void> owner;
    AlignedVector<double> kept;
  };
  struct Lent {
    Memory* memory;   // belongs to the array
    py::array array;  // all arrays that Python has are views of it
  };
  std::vector<Lent> lent_;
};

}  // namespace tribo::python
