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

#include <unordered_map>

namespace tribo {

template <int Dim>
class Cracks {
  using Points = typename Crack<Dim>::Piece;
  using Corners = std::array<Vec<Dim>, static_cast<std::size_t>(Dim)>;
  /// A piece of a crack, or its image in a symmetry plane.
  struct PlacedPiece {
    std::uint32_t crack, piece;
    std::uint32_t surface;  // of which the crack is a part (Crack::surface)
    Points points;
    Corners corners;
    Vec<Dim> mirror;  // factors of vector components: -1 along the normals of the symmetry planes of an image
    Box<Dim> box;

    /// Area times the unit normal to the upper side.
    Vec<Dim> area() const { return Crack<Dim>::area(corners); }
    Vec<Dim> opening(const Crack<Dim>& of, std::size_t point) const { return mirror.cwiseProduct(of.opening(point)); }
  };
  /// Numbers of the surfaces that segments between particles and nodes near one block may cross. The bits of crossings
  /// are positions in it.
  using List = std::vector<std::uint32_t>;

 public:
  Cracks(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers);

  bool active() const { return !system_.cracks.empty(); }
  /// Finds the bins whose particles may have nodes on both sides of a crack until the next sort.
  void locate();
  /// Appends to `blocks` the lattice blocks that `field`, an additional field of a crack, needs.
  void add_blocks(const Field<Dim>& field, std::vector<std::int64_t>& blocks) const;
  /// Finds the sides of all particles near cracks at the nodes of their stencils. To be called at the start of a step.
  void find();
  /// Finds which nodes have mass on both sides of a crack and thus carry its tractions. To be called once the nodal
  /// masses of a step are known and before find_faces().
  void find_face_weights();
  /// Sets the contact law, normal, gap, area, opening, slip and bond of a pair of fields with the given sides at a
  /// node. Returns false if no crack with a contact law separates these fields at the node.
  bool find_faces(ContactPair& pair, const Index<Dim>& node, int side_a, int side_b) const;
  /// Moves the crack faces with the nodal velocities over a time dt.
  void move(double dt);
  /// The pieces that segments from a point to the nodes around it may cross.
  struct NearbyPieces {
    std::vector<const PlacedPiece*> close;  ///< these pieces if they are few
    bool many = false;                      ///< then they are searched for each segment
    const List* list = nullptr;

    bool empty() const { return !many && close.empty(); }
  };
  /// Finds these pieces for the point x [length].
  void find_nearby(const Vec<Dim>& x, NearbyPieces& nearby) const;
  /// Side, as in CutBin, of the point x [length] at a node. `nearby`: result of find_nearby() for a point near x.
  int side_of_node(const NearbyPieces& nearby, const Vec<Dim>& x, const Index<Dim>& node) const;
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
  /// Averages over the crack points near a node, weighted by the shape function of the node.
  struct FaceAverages {
    double area = 0.0, gap = 0.0, slip = 0.0, bond = 0.0;
    Vec<Dim> opening = Vec<Dim>::Zero();
  };

  void register_pieces();
  void list_surfaces(const Box<Dim>& box, std::size_t first, std::size_t end);
  void find_close(const Box<Dim>& box, NearbyPieces& nearby) const;
  /// Calls f(piece), in ascending order, for the pieces whose boxes overlap a box.
  template <class F>
  void each_piece(const Box<Dim>& box, F&& f) const {
    tree_.each([&](const Box<Dim>& other) { return other.overlaps(box); },
               [&](std::size_t first, std::size_t end) {
                 for (std::size_t p = first; p < std::min(end, pieces_.size()); ++p)
                   if (pieces_[p].box.overlaps(box)) f(pieces_[p]);
               });
  }
  template <class F>
  void each_image(const PlacedPiece& piece, F&& f) const;
  const List& near(const Vec<Dim>& x) const;
  void find_bin(Body<Dim>& body, const Bin& bin, CutBin& cut);
  void number_node_surfaces();
  std::int64_t flat(const Index<Dim>& node) const;
  int side_from_crossings(const Index<Dim>& node, std::uint64_t crossed, const List& list) const;
  std::uint64_t crossed(const NearbyPieces& nearby, const Vec<Dim>& from, const Vec<Dim>& to) const;
  Nearest nearest(std::uint32_t surface, const Vec<Dim>& x) const;
  FaceAverages average_faces(std::uint32_t surface, const Vec<Dim>& node, const Nearest& nearest) const;
  double velocity_on_side(Index<Dim> n, int side, Vec<Dim>& v) const;
  bool both_sides(std::uint32_t surface, const Index<Dim>& n) const;
  bool face_velocities(const Crack<Dim>& crack, std::size_t point, const Vec<Dim>& normal,
                       std::array<Vec<Dim>, 2>& v) const;

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  int width_;
  NodesAround<Dim> nodes_around_;
  /// Per crack and integration point of its pieces: the sum of all shape functions divided by their sum over the nodes
  /// with mass on both sides; 0 if the latter is too small.
  std::vector<std::vector<double>> weight_factor_;
  std::vector<PlacedPiece> pieces_;  ///< of all cracks, then their images
  BoxTree<Dim> tree_;                ///< of their boxes
  std::vector<List> lists_;
  std::vector<int> list_of_;          ///< per lattice block: its index in lists_, or -1
  std::vector<std::int64_t> listed_;  ///< blocks with a list
  const List none_;
  /// With several cracks: numbers of the first two surfaces at each node that cracks separate from particles.
  std::unordered_map<std::int64_t, std::array<int, 2>> node_surfaces_;
  struct CutBinPlace {
    Body<Dim>* body;
    std::size_t bin;
  };
  std::vector<CutBinPlace> cut_;  ///< all bins near cracks
  struct PointRecord {
    double area = 0.0, open_weight = 0.0, slip_weight = 0.0, stick_weight = 0.0, slip_length = 0.0, bonded = 0.0,
           broken = 0.0;
    Vec<Dim> force = Vec<Dim>::Zero();
  };
  std::vector<std::vector<PointRecord>> records_;  ///< scratch: per crack and point
};

}  // namespace tribo
