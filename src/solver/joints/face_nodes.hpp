// SPDX-License-Identifier: MIT
/// The nodes that represent one face at an integration point of a joint, and their weights.
#pragma once

#include "solver/cracks/cracks.hpp"
#include "solver/joints/velocity_fit.hpp"
#include "solver/neighbours/nodes_around.hpp"
#include "solver/state/system.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace tribo {

/// One velocity field at one node with its weights for an integration point. A model has many of these, so they are
/// kept small.
template <int Dim>
struct NodeWeight {
  std::uint32_t field : 24;    ///< number of the velocity field
  std::uint32_t mirrored : 8;  ///< bit d is set if component d of vectors changes its sign, as the node is an image
  std::uint32_t node;          ///< position in the nodal arrays of the field
  double mobility;  ///< number of images of the point that act on the node, itself included, over the nodal mass; 0 if
                    ///< the velocity is prescribed [1/mass]
  double weight;    ///< weight of the nodal velocity in the velocity of the face, and of the joint force on the node
  Vec<Dim> slope;   ///< weight of the nodal velocity in the velocity gradient                       [1/length]

  /// A vector at the node in place of the vector at its image, or the other way round.
  Vec<Dim> mirror(const Vec<Dim>& of) const {
    Vec<Dim> out = of;
    for (int d = 0; d < Dim; ++d)
      if (mirrored >> d & 1U) out[d] = -out[d];
    return out;
  }
};

/// The range of nodes that an integration point uses: numbers of the lowest and highest node along each axis.
template <int Dim>
struct NodeRange {
  Index<Dim> low, high;
  NodeRange() { low.fill(std::numeric_limits<int>::max()), high.fill(std::numeric_limits<int>::min()); }
  void include(const Index<Dim>& node) {
    for (std::size_t d = 0; d < node.size(); ++d)
      low[d] = std::min(low[d], node[d]), high[d] = std::max(high[d], node[d]);
  }
};

/// Finds the nodes of faces. Nodal masses must be known.
template <int Dim>
class FaceNodes {
 public:
  FaceNodes(const Model& model, const System<Dim>& system, const Cracks<Dim>& cracks)
      : system_(system), cracks_(cracks), nodes_around_(model, system.lattice) {}

  /// To be called in every step before find(): velocity fields may be added during a run.
  void list_fields();
  /// The velocity fields that a side of a surface of joints can act on. To be called after list_fields().
  const std::vector<std::uint32_t>& fields(const JointSurface<Dim>& surface, std::size_t side) const {
    return surface.crack != JointSurface<Dim>::none ? movable_ : fields_of_[surface.field[side]];
  }
  /// The lowest node around the point x [length]; zeros if some of the nodes lie outside of the lattice.
  Index<Dim> lowest_node(const Vec<Dim>& x) const {
    typename NodesAround<Dim>::Stencil stencil;
    return nodes_around_.find(x, stencil) ? stencil.low : Index<Dim>{};
  }
  /// The masses at the nodes around the last integration point of one side. The next point often has the same nodes.
  struct Memory {
    struct Entry {
      std::size_t position;   // in the stencil
      NodeWeight<Dim> share;  // without the weights, which depend on the point
      Vec<Dim> at;
      double part, mass_of_node;  // share of the field in the nodal mass of all fields, and that mass
    };
    typename NodesAround<Dim>::Stencil stencil;
    const std::vector<std::uint32_t>* fields = nullptr;
    std::vector<Entry> entries;
    std::vector<FitNode<Dim>> fit;
    NodeRange<Dim> range;
  };
  /// Sets `out` to the nodes on one side of a surface of joints (0: body 1, 1: body 2) around a point `x` on the face
  /// [length] whose normal is `n`, with their weights (fit_face_velocity). `out` is empty if there is no mass. Adds the
  /// nodes to `range`. Returns the mass near the point, interpolated with the shape functions [mass]. `memory` holds
  /// what the last call of this step found on the same side.
  double find(const JointSurface<Dim>& surface, const Vec<Dim>& x, const Vec<Dim>& n, std::size_t side, Memory& memory,
              std::vector<NodeWeight<Dim>>& out, NodeRange<Dim>& range) const;

 private:
  void find_masses(const Vec<Dim>& x, const Vec<Dim>& side_point, const typename NodesAround<Dim>::Stencil& stencil,
                   Memory& memory) const;

  const System<Dim>& system_;
  const Cracks<Dim>& cracks_;
  NodesAround<Dim> nodes_around_;
  std::vector<std::vector<std::uint32_t>> fields_of_;  // per field with side 0: it and the fields of its other sides
  std::vector<std::uint32_t> movable_;                 // all fields but those of rigid bodies
};

}  // namespace tribo
