// SPDX-License-Identifier: MIT
/// Cracks in the grid: which field a particle gives to at a node, where faces meet, how they move.
///
/// A particle gives to a node's own field unless the straight way between them crosses a crack; then to the field
/// across. Each node so has one velocity on either side of up to two cracks. Nairn, CMES 4 (2003) 649-663.
#pragma once

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
  /// A piece, or its image in a symmetry plane.
  struct PlacedPiece {
    std::uint32_t crack, piece;
    std::uint32_t bit;  // of the crack in its list
    Points points;
    Corners corners;
    Vec<Dim> mirror;  // factors of vectors: -1 along the axes of the planes
    Vec<Dim> low, high;

    /// Normal times area, to the upper side.
    Vec<Dim> area() const { return Crack<Dim>::area(corners); }
    Vec<Dim> opening(const Crack<Dim>& of, std::size_t point) const { return mirror.cwiseProduct(of.opening(point)); }
  };
  /// Pieces that ways from or to one block may cross, and their cracks.
  struct List {
    std::vector<PlacedPiece> pieces;
    std::vector<std::uint32_t> cracks;
  };

 public:
  Cracks(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers);

  bool active() const { return !system_.cracks.empty(); }
  /// Finds the bins that cracks may cut until the next sort.
  void locate();
  /// Blocks of the lattice that the across fields of a field need.
  void add_blocks(const Field<Dim>& field, std::vector<std::int64_t>& blocks) const;
  /// Finds the sides of all particles near cracks; at the start of a step.
  void find();
  /// Finds which nodes carry the faces; once the masses of a step are known, before meet().
  void find_carrying_nodes();
  /// Whether fields of these sides face each other across a crack of this node; if so the pair's law, normal, gap,
  /// area, opening and memory. False if nothing acts between them.
  bool find_faces(ContactPair& pair, const Index<Dim>& node, int side_a, int side_b) const;
  /// Moves the faces with the velocities of the nodes.
  void move(double dt);
  /// The pieces that ways from a point to the nodes around it may cross.
  struct NearbyPieces {
    std::vector<const PlacedPiece*> close;
    const List* list = nullptr;
  };
  void find_nearby(const Vec<Dim>& x, NearbyPieces& nearby) const;
  /// Side, as in CutBin, on which a way ends at a node that begins in `x`, next to where look() was.
  int side_of_node(const NearbyPieces& nearby, const Vec<Dim>& x, const Index<Dim>& node) const;
  /// Shows and remembers what a pair did at a node; begin() before the first of a step, end() after the last.
  void begin_record();
  void record(const ContactPair& pair, const Index<Dim>& node);
  void end_record();

 private:
  /// Where a crack is nearest to a point.
  struct Nearest {
    const PlacedPiece* piece = nullptr;
    Vec<Dim> at, normal;            // to the upper side
    std::array<double, Dim> share;  // of the corners
    int side = 1;                   // the point's: 1 above
  };
  /// What the points of a crack say at a node, weighted by its shape function.
  struct FaceAverages {
    double area = 0.0, gap = 0.0, slip = 0.0, bond = 0.0;
    Vec<Dim> opening = Vec<Dim>::Zero();
  };

  void register_pieces();
  void register_piece(const PlacedPiece& piece);
  template <class F>
  void each_image(const PlacedPiece& piece, F&& f) const;
  const List& near(const Vec<Dim>& x) const;
  void find_bin(Body<Dim>& body, const Bin& bin, CutBin& cut);
  void number_node_cracks();
  std::int64_t flat(const Index<Dim>& node) const;
  int side_from_crossings(const Index<Dim>& node, std::uint64_t crossed, const List& list) const;
  std::uint64_t crossed(const std::vector<const PlacedPiece*>& pieces, const Vec<Dim>& from, const Vec<Dim>& to) const;
  Nearest nearest(std::uint32_t crack, const Vec<Dim>& x) const;
  FaceAverages average_faces(std::uint32_t crack, const Vec<Dim>& node, const Nearest& nearest) const;
  double velocity_on_side(Index<Dim> n, int side, Vec<Dim>& v) const;
  bool both_sides(std::uint32_t crack, const Index<Dim>& n) const;
  bool face_velocities(const Crack<Dim>& crack, std::size_t point, const Vec<Dim>& normal,
                       std::array<Vec<Dim>, 2>& v) const;

  const Model& model_;
  System<Dim>& system_;
  const Transfers<Dim>& transfers_;
  int width_;
  NodesAround<Dim> around_;
  /// Per crack, piece and point of its sums: over the share of the weight at nodes that both faces reach; 0: too small.
  std::vector<std::vector<double>> weight_factor_;
  std::vector<List> lists_;
  std::vector<int> list_of_;          ///< per lattice block: which of lists_, or -1
  std::vector<std::int64_t> listed_;  ///< blocks that have one
  const List none_;
  /// With several cracks: numbers of the first two at each node they touch.
  std::unordered_map<std::int64_t, std::array<int, 2>> node_cracks_;
  struct CutBinPlace {
    Body<Dim>* body;
    std::size_t bin;
  };
  std::vector<CutBinPlace> cut_;  ///< all cut bins
  struct PointRecord {
    double area = 0.0, open = 0.0, slides = 0.0, sticks = 0.0, way = 0.0, whole = 0.0, broken = 0.0;
    Vec<Dim> force = Vec<Dim>::Zero();
  };
  std::vector<std::vector<PointRecord>> records_;  ///< scratch: per crack and point
};

}  // namespace tribo
