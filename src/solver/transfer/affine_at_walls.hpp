// SPDX-License-Identifier: MIT
/// The affine momentum of APIC next to walls.
#pragma once

#include "grid/kernels.hpp"
#include "model/model.hpp"
#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// Corrects the nodal momenta of APIC next to walls with boundary-modified splines, see EdgeExchange.
///
/// The value of a node beyond a wall follows from those of the first two nodes inside, so that what particles scatter
/// to it belongs to these two, with the weights 2 and -1. A particle scatters the momentum w m (v + C (x_i - x)) to a
/// node i. For the weights of both nodes, the affine part must be read at their own positions; the node beyond the wall
/// has it at its own. Without this correction a velocity that is linear across the wall grows in every step by the
/// factor 1 + 2 w / w_1, with w_1 the modified weight of the first node off the wall, and energy comes from nowhere.
/// Particles next to cracks are left out.
template <int Dim>
class AffineAtWalls {
 public:
  AffineAtWalls(const Model& model, const Lattice<Dim>& lattice);

  /// Adds the corrections for a body to the momenta of its field after the scatter and before EdgeExchange::sum_images.
  /// `from_start`: the particles are at their positions at the start of the step.
  void add(Body<Dim>& body, const BlockMap<Dim>& map, NodeLayer& nodes, bool from_start) const;

 private:
  struct Wall {
    std::size_t axis;
    int node, inward;  // index of the nodes on the wall; inward: 1 at the low end, -1 at the high end
  };

  bool near(const Bin& bin, const Wall& wall) const;
  template <class Spline>
  void add_particle(const Wall& wall, const Vec<Dim>& x, const Vec<Dim>& momentum, const BlockMap<Dim>& map,
                    NodeLayer& nodes) const;

  const Lattice<Dim>& lattice_;
  Kernel kernel_;
  std::vector<Wall> walls_;  // empty unless the transfer is APIC and the shape functions are splines
};

}  // namespace tribo
