// SPDX-License-Identifier: MIT
/// The part of the pre-flight report on cracks and on joints between materials.
#pragma once

#include "solver/state/system.hpp"

#include <string>
#include <vector>

namespace tribo {

struct CrackReport {
  std::vector<std::string> lines;   ///< one per crack or pair: pieces, size, cells
  std::vector<std::string> advice;  ///< what the grid cannot resolve
};

/// Of a system before the first step.
template <int Dim>
CrackReport describe_cracks(const System<Dim>& system);
/// The same of joints between materials: points, size, cells.
template <int Dim>
CrackReport describe_interfaces(const System<Dim>& system);

}  // namespace tribo
