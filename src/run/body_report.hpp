// SPDX-License-Identifier: MIT
/// The part of the pre-flight report on bodies: their particles, volumes and thickness.
#pragma once

#include "model/model.hpp"
#include "particles/seeds.hpp"
#include "run/remarks.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// A line for each body with its number of particles, its volume, the exact volume if it is known, and its thickness if
/// it is thin, in which many bodies of a material share a line; and a line for each table of particles. Advice on
/// bodies whose particles do not fill them, and on thin bodies.
template <int Dim>
Remarks describe_bodies(const Model& model, const System<Dim>& system, const Seeds& seeds);

}  // namespace tribo
