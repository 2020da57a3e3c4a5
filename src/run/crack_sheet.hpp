// SPDX-License-Identifier: MIT
/// What the pre-flight sheet says of cracks and of joints between materials.
#pragma once

#include "solver/state/system.hpp"

#include <string>
#include <vector>

namespace tribo {

struct CrackSheet {
  std::vector<std::string> lines;   ///< one per crack or pair: pieces, size, cells
  std::vector<std::string> advice;  ///< what the grid cannot resolve
};

/// Before the first step.
template <int Dim>
CrackSheet describe_cracks(const System<Dim>& system);
/// The same of joints between materials: points, size, cells.
template <int Dim>
CrackSheet describe_interfaces(const System<Dim>& system);

}  // namespace tribo
