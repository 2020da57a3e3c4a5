// SPDX-License-Identifier: MIT
#include <p4est_bits.h>
#include <p4est_communication.h>
#include <p4est_extended.h>
#include <p4est_ghost.h>

#include "mpi/block_forest_implementation.hpp"

namespace tribo {

std::unique_ptr<Partition<2>> make_forest_2d(const Lattice<2>& lattice, int layers) {
  return std::make_unique<BlockForest<2>>(lattice, layers);
}

}  // namespace tribo
