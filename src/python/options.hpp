// SPDX-License-Identifier: MIT
/// Options of runs that Python gives as a dictionary.
#pragma once

#include "python/bindings.hpp"
#include "run/simulation.hpp"

namespace tribo::python {

/// From the entries folder, threads, quiet, overwrite, resume, max_wall and command_line; all but the first and the
/// last may be missing or None.
RunOptions options_of(const py::dict& given);

}  // namespace tribo::python
