// SPDX-License-Identifier: MIT
/// Energies, momenta and means of bodies: sums over particles that do not depend on the number of threads or processes.
/// All processes must ask for them together.
#pragma once

#include "model/measures.hpp"
#include "solver/state/system.hpp"

#include <optional>
#include <vector>

namespace tribo {

/// Measures of one body. `strain`: include the mean Biot strain, which requires F.
template <int Dim>
Measures measure(Body<Dim>& body, bool strain = false);
/// Measures of one particle.
template <int Dim>
Measures measure_particle(Body<Dim>& body, std::size_t particle, bool strain);
/// Measures of all deformable bodies together, or only of those of a material (index into Model::materials); means are
/// weighted by mass or volume.
template <int Dim>
Measures measure(System<Dim>& system, bool strain = false, std::optional<int> material = std::nullopt);
/// Measures of all deformable bodies together; those of each body are stored in `bodies`.
template <int Dim>
Measures measure_all(System<Dim>& system, bool strain, std::vector<Measures>& bodies);

}  // namespace tribo
