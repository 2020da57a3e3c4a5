// SPDX-License-Identifier: MIT
/// The part of the pre-flight report on cracks and on joints between materials.
#pragma once

#include "run/remarks.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// One line per crack or pair: pieces, size, cells; and what the grid cannot resolve. Of a system before the first
/// step.
template <int Dim>
Remarks describe_cracks(const Model& model, const System<Dim>& system);
/// The same of joints between materials: points, size, cells.
template <int Dim>
Remarks describe_interfaces(const System<Dim>& system);
/// Advice on joints and interfaces between bodies at an angle to the grid, whose ends splines do not resolve. Of a
/// system after its first step, which finds the points of interfaces.
template <int Dim>
std::vector<std::string> remarks_on_inclined_joints(const Model& model, const System<Dim>& system);

}  // namespace tribo
