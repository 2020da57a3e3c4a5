// SPDX-License-Identifier: MIT
/// The blocks of a lattice as leaves of a forest of quadtrees or octrees (p4est).
#pragma once

#include "grid/partition.hpp"

#include <memory>

namespace tribo {

/// Divides the blocks along the space-filling curve of p4est. Throws FileError without memory.
std::unique_ptr<Partition<2>> make_forest_2d(const Lattice<2>& lattice, int layers);
std::unique_ptr<Partition<3>> make_forest_3d(const Lattice<3>& lattice, int layers);

}  // namespace tribo
