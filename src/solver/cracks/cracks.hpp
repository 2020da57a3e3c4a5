// SPDX-License-Identifier: MIT
/// Cracks in the grid: the velocity field of each particle at each node, contact between the crack faces, and their
/// motion.
///
/// A particle belongs to the base field of a node unless the segment between them crosses a crack; then it belongs to
/// an additional field. A node thus has a separate velocity on either side of up to two cracks. Nairn, CMES 4 (2003)
/// 649-663.
#pragma once

#include "solver/cracks/box_tree.hpp"
#include "solver/exchange/exchange.hpp"
#include "solver/neighbours/nodes_around.hpp"
#include "solver/state/contact_pair.hpp"
#include "solver/transfer/transfer.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace tribo {

template <int Dim>
class Cracks {
  using Points = typename Crack<Dim>::Piece;
  using Stencil = typename NodesAround<Dim>::Stencil;
  using Corners = std::array<Vec<Dim>, static_cast<std::size_t>(Dim)>;
  /// A piece of a crack, or its image in a symmetry plane.
  struct PlacedPiece {
    std::uint32_t crack, piece;
    std::uint32_t surface;  // of which the crack is a part (Crack::surface)
    Points points;
    Corners corners;
    Box<Dim> box;

    /// Area times the unit normal to the upper side.
    Vec<Dim> area() const { return Crack<Dim>::area(corners); }
  };
  /// Numbers of the surfaces that segments between particles and nodes near one block may cross. The bits of crossings
  /// are positions in it.
  using List = std::vector<std::uint32_t>;
  /// The bit of a surface in a list; 0 if it is not in the list.
  static std::uint64_t bit_of(std::uint32_t surface, const List& list) {
    const auto found = std::find(list.begin(), list.end(), surface);
    return found != list.end() ? std::uint64_t{1} << (found - list.begin()) : 0;
  }

 public:
  Cracks(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers);

  bool active() const { return !system_.cracks.empty(); }
  /// Finds the bins whose particles may have nodes on both sides of a crack until the next sort.
  void locate();
  /// Appends to `blocks` the lattice blocks that `field`, an additional field of a crack, needs.
  void add_blocks(const Field<Dim>& field, std::vector<BlockReach<Dim>>& blocks) const;
  /// Finds the sides of all particles near cracks at the nodes of their stencils. To be called at the start of a step.
  void find();
  /// Integrates the faces for the nodes that have mass on both sides of a crack and thus carry its tractions. To be
  /// called once the nodal masses of a step are known and before find_faces().
  void integrate_faces();
  /// Sets the contact law, normal, gap, area, slip and bond of a pair of fields with the given sides at a node.
  /// Returns false if no crack with a contact law separates these fields at the node.
  bool find_faces(ContactPair& pair, const Index<Dim>& node, int side_a, int side_b) const;
  /// Moves the crack faces with the nodal velocities over a time dt.
  void move(double dt);
  /// Two parallel planes between which all pieces lie that touch a cell.
  struct Slab {
    Vec<Dim> normal;   ///< unit vector
    double low, high;  ///< positions of the planes along it [length]
  };
  /// Nodes of a box of the grid with the surfaces that separate them from each other.
  struct NodeBox {
    Index<Dim> low{}, high{};
    const List* list = nullptr;  ///< of the surfaces of the bits
    bool has_end = false;        ///< an edge of a surface lies in the box: the bits of the nodes have no meaning
    bool is_cut = false;         ///< a surface passes through the box
    /// Per node, x fastest: the surfaces that separate it from the lowest one.
    std::vector<std::uint64_t> crossed;
    std::vector<const Slab*> slabs;  ///< of the cell above each node; null if no piece touches it
    std::uint64_t step = 0;          ///< in which this was found

    std::size_t at(const Index<Dim>& node) const {
      std::size_t n = 0;
      for (std::size_t d = Dim; d-- > 0;)
        n = n * static_cast<std::size_t>(high[d] - low[d] + 1) + static_cast<std::size_t>(node[d] - low[d]);
      return n;
    }
  };
  /// The surfaces between a point and the nodes of a box.
  struct PointSides {
    const NodeBox* nodes = nullptr;
    Vec<Dim> x;
    bool by_segment = false;    ///< every segment to a node is tested for itself
    std::uint64_t crossed = 0;  ///< else: between the point and the lowest node of the box
  };
  /// Finds the nodes around the point x [length]. Returns true if `nodes` holds them already.
  bool find_nodes(const Vec<Dim>& x, NodeBox& nodes) const;
  /// The surfaces between the point x [length] and `nodes`, which must exist as long as the result.
  PointSides sides_of(const NodeBox& nodes, const Vec<Dim>& x) const;
  /// Side, as in CutBin, of a point at one of the nodes around it.
  int side_of_node(const PointSides& point, const Index<Dim>& node) const;
  /// Stores the contact status, slip, bond and traction of a pair at a node for the points of the crack.
  /// begin_record() is called before the first pair of a step and end_record() after the last.
  void begin_record();
  void record(const ContactPair& pair, const Index<Dim>& node);
  void end_record();

 private:
  /// The closest point of a surface.
  struct Nearest {
    const PlacedPiece* piece = nullptr;
    Vec<Dim> at, normal;            // closest point [length], unit normal to the upper side
    std::array<double, Dim> share;  // barycentric coordinates of `at`
    int side = 1;                   // side of the point from which the search started: 1 upper, -1 lower
  };
  /// Integrals over a surface near a node, weighted by the shape function of the node, or, divided by the area, means.
  struct FaceAverages {
    double area = 0.0, gap = 0.0, slip = 0.0, bond = 0.0;
  };

  void register_pieces();
  /// A segment that crosses a piece may begin this far from its box [length].
  Vec<Dim> list_reach() const { return (width_ + 1.0) * system_.lattice.spacing; }
  void list_surfaces(const Box<Dim>& box, std::size_t first, std::size_t end);
  void find_ends();
  void find_edge_crossings();
  void find_box(const Index<Dim>& low, const Index<Dim>& high, const List& list, NodeBox& nodes) const;
  template <class F>
  void each_image(const PlacedPiece& piece, F&& f) const;
  const List& near(const Vec<Dim>& x) const;
  void find_bin(Body<Dim>& body, const Bin& bin, CutBin& cut);
  void number_node_surfaces();
  std::int64_t flat(const Index<Dim>& node) const;
  int side_from_crossings(const Index<Dim>& node, std::uint64_t crossed, const List& list) const;
  std::uint64_t crossed(const List& list, const Vec<Dim>& from, const Vec<Dim>& to) const;
  std::uint64_t crossed(const PointSides& point, const Index<Dim>& node) const;
  std::uint64_t crossed_in_cell(const NodeBox& nodes, const Index<Dim>& cell, const Vec<Dim>& x) const;
  /// What the surfaces of a block's list do in the block. Bits are positions in that list.
  struct BlockCrossings {
    /// Per node and axis: the surfaces that cross the edge to the next node an odd number of times.
    std::array<std::array<std::uint64_t, static_cast<std::size_t>(Dim)>, block_nodes<Dim>> edges;
    std::array<int, block_nodes<Dim>> slab;  // per cell, by its lowest node: position in `slabs`, or -1
    std::vector<Slab> slabs;

    void clear() { edges.fill({}), slab.fill(-1), slabs.clear(); }
  };
  void extend_slab(const Index<Dim>& cell, const PlacedPiece& piece);
  /// Index of the crossings of a node's block in crossings_ and of the node in them; -1: no surface is near.
  std::pair<int, std::size_t> place_of(const Index<Dim>& node) const;
  Nearest nearest(std::uint32_t surface, const Vec<Dim>& x) const;
  FaceAverages average_faces(std::uint32_t surface, const Index<Dim>& node, const Nearest& nearest) const;
  struct FaceSums;
  void begin_sums(const Crack<Dim>& crack, const Stencil& nodes, FaceSums& sums) const;
  void add_to_sums(const Crack<Dim>& crack, std::size_t piece, FaceSums& sums) const;
  void end_sums(const Crack<Dim>& crack, FaceSums& sums) const;
  double sum_side(Index<Dim> n, int side, Vec<Dim>& v) const;
  double velocity_on_side(const Index<Dim>& n, int side, Vec<Dim>& v) const;
  /// Number of the sides that a node may have, see CutBin.
  int sides() const { return system_.cracks.size() > 1 ? 4 : 2; }
  void find_side_velocities();
  bool has_mass(const Index<Dim>& n) const;
  bool both_sides(std::uint32_t surface, const Index<Dim>& n) const;
  bool has_both_sides(std::uint32_t surface, const Index<Dim>& n) const;
  std::array<PointSides, 2> sides_of_faces(const Crack<Dim>& crack, std::size_t point, const Vec<Dim>& normal,
                                           const NodeBox& around, const PointSides* before) const;
  struct FaceNodes;
  void find_face_nodes(const std::array<PointSides, 2>& sides, const Stencil& nodes, FaceNodes& of_faces) const;
  bool face_velocities(const Crack<Dim>& crack, std::size_t point, const std::array<PointSides, 2>& sides,
                       FaceNodes& of_faces, std::array<Vec<Dim>, 2>& v) const;
  /// Calls f(local, node) for the nodes of a listed block.
  template <class F>
  void each_node(std::size_t list, F&& f) const {
    Index<Dim> low = listed_[list], high;
    for (std::size_t d = 0; d < Dim; ++d) low[d] *= block_edge<Dim>, high[d] = low[d] + block_edge<Dim> - 1;
    std::size_t local = 0;
    each_in_box<Dim>(low, high, [&](const Index<Dim>& n) { f(local++, n); });
  }

  /// Points or pieces of a crack that a thread visits in turn.
  static constexpr std::size_t part_of_crack = 256;

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  int width_;
  NodesAround<Dim> nodes_around_;
  /// What the nodes of a listed block know of the surfaces in its list. Bits and offsets are positions in that list.
  struct BlockFaces {
    std::array<std::uint64_t, block_nodes<Dim>> both{};  ///< the surfaces with mass on both sides at each node
    std::vector<FaceAverages> integrals;                 ///< per surface and node
    /// Per node and side: the mass of its fields and their mean velocity.
    std::array<std::array<double, 4>, block_nodes<Dim>> mass;
    std::array<std::array<Vec<Dim>, 4>, block_nodes<Dim>> velocity;
    std::array<int, block_nodes<Dim>> record;  ///< per node: the number of its last record, or -1
  };
  std::vector<BlockFaces> block_faces_;  ///< per list
  /// A share of BlockFaces::integrals.
  struct NodeIntegral {
    std::size_t list, at;
    FaceAverages sum;
  };
  std::vector<std::vector<NodeIntegral>> integrals_of_parts_;  ///< per part of the pieces of a crack
  std::vector<PlacedPiece> pieces_;                            ///< of all cracks, then their images
  BoxTree<Dim> tree_;                                          ///< of their boxes
  /// Per crack: the edges of its surface, which belong to one piece only (points in two dimensions).
  std::vector<std::vector<std::array<std::uint32_t, static_cast<std::size_t>(Dim - 1)>>> ends_;
  std::vector<std::size_t> pieces_of_ends_;  ///< per crack: the number of pieces for which these were found
  std::vector<Box<Dim>> end_boxes_;          ///< of the edges of all surfaces
  BoxTree<Dim> end_tree_;
  std::vector<List> lists_;
  std::vector<BlockCrossings> crossings_;  ///< per list
  std::uint64_t step_ = 0;                 ///< number of the last call of find(), of any model
  BlockTable<Dim, int> list_of_{-1};       ///< per block: its index in lists_, or -1
  std::vector<Index<Dim>> listed_;         ///< blocks with a list
  const List none_;
  /// With several cracks: numbers of the first two surfaces at each node that cracks separate from particles.
  std::unordered_map<std::int64_t, std::array<int, 2>> node_surfaces_;
  struct CutBinPlace {
    Body<Dim>* body;
    std::size_t bin;
  };
  std::vector<CutBinPlace> cut_;  ///< all bins near cracks
  /// What contact did at a node to the faces of a crack.
  struct NodeRecord {
    int crack, next;  ///< number of the next record of the same node, or -1
    double area, slip;
    ContactStatus status;
    Bond bond;
    Vec<Dim> normal, force;
  };
  std::vector<NodeRecord> records_;
};

}  // namespace tribo
