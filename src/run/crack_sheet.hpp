/// What the pre-flight sheet says of cracks.
#pragma once

#include "solver/system.hpp"

#include <string>
#include <vector>

namespace tribo {

struct CrackSheet {
  std::vector<std::string> lines;   ///< one per crack: pieces, size, cells
  std::vector<std::string> advice;  ///< what the grid cannot resolve
};

/// Before the first step.
template <int Dim>
CrackSheet describe_cracks(const System<Dim>& system);

}  // namespace tribo
