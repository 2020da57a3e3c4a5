// SPDX-License-Identifier: MIT
/// Image nodes at the edges of the grid.
#pragma once

#include "base/ranks.hpp"
#include "solver/exchange/exchange.hpp"

#include <optional>
#include <vector>

namespace tribo {

/// The exchange of a grid without images.
template <int Dim>
class OpenExchange final : public Exchange<Dim> {
 public:
  void locate(const BlockMap<Dim>&) override {}
  void sum_images(NodeNumbers, ImageValues) const override {}
  void copy_images(NodeNumbers, ImageValues) const override {}
  double ownership(std::int64_t) const override { return 1.0; }
  bool has_images() const override { return false; }
  bool is_image(const Index<Dim>&) const override { return false; }
  int mirrored_axes(const Index<Dim>&) const override { return 0; }
  int reflect(Index<Dim>&) const override { return 0; }
  void begin_step() override {}
  void add_plane_reactions(const NodeLayer&) override {}
  void hold_planes(NodeLayer&) override {}
  void end_step() override {}
  double plane_reaction(int, int) const override { return 0.0; }
};

/// The exchange of a grid with symmetry planes, walls or periodic edges. A symmetry plane adds the mirror image. A
/// wall yields the boundary-modified shape functions, in which the k-th node beyond the wall has the value (k+1) v0 -
/// k v1 of the first two nodes inside (Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922-948); it is
/// exact for linear
/// fields. On a periodic axis the nodes from the lowest to the last but one represent all nodes at a distance of a
/// whole number of periods.
template <int Dim>
class EdgeExchange final : public Exchange<Dim> {
 public:
  /// Throws InputError for a plane that is not a grid line.
  EdgeExchange(const GridSpec& grid, const Lattice<Dim>& lattice);

  /// Whether there is any plane, wall or periodic edge.
  bool any() const { return !planes_.empty(); }
  void locate(const BlockMap<Dim>& map) override;
  void sum_images(NodeNumbers nodes, ImageValues values) const override;
  void copy_images(NodeNumbers nodes, ImageValues values) const override;
  double ownership(std::int64_t node) const override {
    return ownership_.empty() ? 1.0 : ownership_[static_cast<std::size_t>(node)];
  }
  bool has_images() const override { return any(); }
  bool is_image(const Index<Dim>& node) const override;
  int mirrored_axes(const Index<Dim>& node) const override;
  int reflect(Index<Dim>& node) const override;
  void begin_step() override;
  void add_plane_reactions(const NodeLayer& nodes) override;
  void hold_planes(NodeLayer& nodes) override;
  void end_step() override;
  double plane_reaction(int axis, int side) const override;

 private:
  enum class Edge { symmetry, wall, period };
  struct Plane {
    int axis, node, inward;  // inward: +1 at the low end, -1 at the high end; for a period, its number of cells
    Edge kind;
  };
  // An image `depth` nodes beyond a plane, with the node on the plane, and the node inside: its counterpart for a
  // mirror or a period, or the first node inside of a wall.
  struct Image {
    std::int64_t image, plane, inside;
    int depth;
  };
  struct OnPlane {
    std::int64_t node;
    std::size_t plane;
  };

  bool is_own(std::int64_t node) const { return own_[static_cast<std::size_t>(node) / block_nodes<Dim>] != 0; }
  std::optional<Image> image_of(const Plane& plane, std::int64_t at, Index<Dim> node, const BlockMap<Dim>& map) const;

  std::vector<Plane> planes_;
  std::vector<std::vector<Image>> images_;  // per plane
  std::vector<OnPlane> mirror_nodes_[3];    // nodes on symmetry planes, by axis
  std::vector<double> ownership_;           // empty without symmetry planes
  std::vector<char> own_;                   // per block of the map: whether sums of this process contain its nodes
  SumList reactions_;                       // per plane
};

}  // namespace tribo
