// SPDX-License-Identifier: MIT
/// The columns of particles that a transfer to nodes reads.
#pragma once

#include "solver/transfer/transfer.hpp"

#include <cstddef>
#include <vector>

namespace tribo {

/// The numbers of the columns of a body that a scatter reads and that change between two sorts. Positions and domains,
/// which all scatters read, are listed for that of the momentum only: it is the first one of a step, and they stay
/// until the particles move. `from_start`: see Transfers::scatter.
template <int Dim>
std::vector<std::size_t> scattered_columns(Body<Dim>& body, Scatter what, bool from_start);

}  // namespace tribo
