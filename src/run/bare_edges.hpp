// SPDX-License-Identifier: MIT
/// Edges of the grid that hold bodies by prescribed velocities only, under shape functions that extend beyond.
#pragma once

#include "model/model.hpp"

#include <string>
#include <vector>

namespace tribo {

/// One line of advice for every edge of the grid on which conditions hold at least half of the nodes in the direction
/// of the normal, but not the nodes beyond, if the shape functions are B-splines and the edge is neither a wall nor a
/// plane of symmetry. Near such an edge bodies stop up to half a cell away, or pass it.
std::vector<std::string> bare_edges(const Model& model);

}  // namespace tribo
