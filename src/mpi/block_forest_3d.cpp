// SPDX-License-Identifier: MIT
// In three dimensions the functions of p4est have other names, which this header gives them.
#include <p4est_to_p8est.h>

#include <p8est_bits.h>
#include <p8est_communication.h>
#include <p8est_extended.h>
#include <p8est_ghost.h>

#include "mpi/block_forest_implementation.hpp"

namespace tribo {

std::unique_ptr<Partition<3>> make_forest_3d(const Lattice<3>& lattice, int layers) {
  return std::make_unique<BlockForest<3>>(lattice, layers);
}

}  // namespace tribo
