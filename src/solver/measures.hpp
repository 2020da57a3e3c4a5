// SPDX-License-Identifier: MIT
/// Sums over all particles, always added up in the same order: energies, momenta, means.
#pragma once

#include "model/measures.hpp"
#include "solver/state/system.hpp"

namespace tribo {

template <int Dim>
Measures measure(Body<Dim>& body, bool strain = false);
/// Of one particle.
template <int Dim>
Measures measure_particle(Body<Dim>& body, std::size_t particle, bool strain);
/// Sum over bodies; means weighted by mass or volume.
template <int Dim>
Measures measure(System<Dim>& system, bool strain = false);

}  // namespace tribo
