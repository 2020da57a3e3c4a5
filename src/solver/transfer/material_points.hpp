// SPDX-License-Identifier: MIT
/// Access of a material law to a batch of particles, and the energies that the law computes.
#pragma once

#include "solver/state/system.hpp"

#include <array>

namespace tribo {

/// Pointers to the history columns of a batch; MaterialPoints::history refers to them.
using HistoryPointers = std::array<double*, most_history_variables>;

/// Pointers into the columns of the particles first ... first + count - 1 of a body. `history` must outlive the result.
template <int Dim>
MaterialPoints<Dim> points_of(Body<Dim>& body, std::uint32_t first, int count, HistoryPointers& history);

/// Elastic energy stored in one particle [energy].
template <int Dim>
double stored_energy(Body<Dim>& body, std::size_t particle);
/// Energy that the material law has dissipated in one particle since the start [energy]; 0 for laws that dissipate
/// none.
template <int Dim>
double dissipated_energy(Body<Dim>& body, std::size_t particle);

}  // namespace tribo
