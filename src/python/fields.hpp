// SPDX-License-Identifier: MIT
/// Fields of particles as arrays of Python.
#pragma once

#include "output/vtk.hpp"
#include "python/bindings.hpp"

#include <cstddef>

namespace tribo::python {

/// A copy of rows of numbers: an array of shape (count,), or (count, width) for vectors and tensors.
py::array array_of(const OutputRows& rows, std::size_t count);
/// A copy of a field.
py::array array_of(const OutputField& field, std::size_t count);

}  // namespace tribo::python
