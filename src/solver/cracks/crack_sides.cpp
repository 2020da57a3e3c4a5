// SPDX-License-Identifier: MIT
/// Which cracks separate particles and points from nodes.
///
/// The surfaces that cross a closed path an odd number of times are those with an edge (an end in two dimensions) that
/// the path encircles. Where no edge is near, the surfaces between a point and a node therefore follow from those
/// between the point and a corner of its cell and from those between neighbouring nodes, which are found once for all.
/// All tests of segments are exact, so that this gives the same result as a test of the segment from the point to the
/// node.

#include "base/parallel.hpp"
#include "geometry/crossing.hpp"
#include "solver/cracks/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tribo {
namespace {

// Tolerance of coordinates for round-off [cells].
constexpr double round_off = 1e-9;

// The bits of the surfaces of the list `from` as positions in the list `to`. Surfaces not in that list are not near.
std::uint64_t translated(std::uint64_t bits, const std::vector<std::uint32_t>& from,
                         const std::vector<std::uint32_t>& to) {
  if (bits == 0 || &from == &to) return bits;
  std::uint64_t out = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!(bits >> k & 1)) continue;
    const auto found = std::find(to.begin(), to.end(), from[k]);
    if (found != to.end()) out ^= std::uint64_t{1} << (found - to.begin());
  }
  return out;
}

// The edges of a surface: the sides (points in two dimensions) of an odd number of pieces.
template <int Dim>
std::vector<std::array<std::uint32_t, static_cast<std::size_t>(Dim - 1)>> edges_of(const Crack<Dim>& crack) {
  using Side = std::array<std::uint32_t, static_cast<std::size_t>(Dim - 1)>;
  std::map<Side, bool> odd;
  for (const auto& piece : crack.pieces)
    for (std::size_t k = 0; k < piece.size(); ++k) {
      Side side;
      for (std::size_t i = 0; i < side.size(); ++i) side[i] = piece[(k + i) % piece.size()];
      std::sort(side.begin(), side.end());
      bool& is_odd = odd[side];
      is_odd = !is_odd;
    }
  std::vector<Side> out;
  for (const auto& [side, is_odd] : odd)
    if (is_odd) out.push_back(side);
  return out;
}

}  // namespace

// The boxes of the edges of all surfaces. Lines that have a common end in space but are different cracks may move
// apart, and a crack may lie in a symmetry plane, so that the points where they meet also count as edges.
template <int Dim>
void Cracks<Dim>::find_ends() {
  const auto& planes = nodes_around_.planes();
  ends_.resize(system_.cracks.size()), pieces_of_ends_.resize(system_.cracks.size(), 0);
  end_boxes_.clear();
  const auto add = [&](const Vec<Dim>& a, const Vec<Dim>& b) {
    std::vector<Box<Dim>> boxes{{a.cwiseMin(b), a.cwiseMax(b)}};
    for (const SymmetryPlane& plane : planes)
      for (std::size_t k = 0, count = boxes.size(); k < count; ++k) {
        Box<Dim> image = boxes[k];
        image.low[plane.axis] = 2 * plane.at - boxes[k].high[plane.axis];
        image.high[plane.axis] = 2 * plane.at - boxes[k].low[plane.axis];
        boxes.push_back(image);
      }
    end_boxes_.insert(end_boxes_.end(), boxes.begin(), boxes.end());
  };
  for (std::size_t c = 0; c < system_.cracks.size(); ++c) {
    const Crack<Dim>& crack = system_.cracks[c];
    if (pieces_of_ends_[c] != crack.pieces.size()) ends_[c] = edges_of(crack), pieces_of_ends_[c] = crack.pieces.size();
    for (const auto& end : ends_[c]) add(crack.x[end.front()], crack.x[end.back()]);
    if (planes.empty()) continue;
    for (const Vec<Dim>& x : crack.x)
      if (nodes_around_.planes_through(x) > 0) add(x, x);
  }
  end_tree_.build(end_boxes_.size(), [&](std::size_t k) { return end_boxes_[k]; });
}

template <int Dim>
std::pair<int, std::size_t> Cracks<Dim>::place_of(const Index<Dim>& node) const {
  Index<Dim> block;
  std::size_t local = 0;
  for (std::size_t d = Dim; d-- > 0;) {
    if (node[d] < 0) return {-1, 0};
    block[d] = node[d] / block_edge<Dim>;
    local = local * block_edge<Dim> + static_cast<std::size_t>(node[d] % block_edge<Dim>);
  }
  return {list_of_[block], local};
}

// Extends the slab of a cell by a piece that touches the cell. Its normal is that of the first piece.
template <int Dim>
void Cracks<Dim>::extend_slab(const Index<Dim>& cell, const PlacedPiece& piece) {
  const auto [list, local] = place_of(cell);
  if (list < 0) return;
  BlockCrossings& block = crossings_[static_cast<std::size_t>(list)];
  if (block.slab[local] < 0) {
    const Vec<Dim> area = piece.area();
    const double infinity = std::numeric_limits<double>::infinity();
    block.slab[local] = static_cast<int>(block.slabs.size());
    block.slabs.push_back({area.norm() > 0 ? area.normalized() : Vec<Dim>(Vec<Dim>::Unit(0)), infinity, -infinity});
  }
  Slab& slab = block.slabs[static_cast<std::size_t>(block.slab[local])];
  for (const Vec<Dim>& corner : piece.corners) {
    const double at = corner.dot(slab.normal);
    slab.low = std::min(slab.low, at), slab.high = std::max(slab.high, at);
  }
}

// The edges between nodes that pieces cross, and the slabs of the cells that they touch.
template <int Dim>
void Cracks<Dim>::find_edge_crossings() {
  if (crossings_.size() < listed_.size()) crossings_.resize(listed_.size());
  for (std::size_t list = 0; list < listed_.size(); ++list) crossings_[list].clear();
  const Lattice<Dim>& lattice = system_.lattice;
  struct CellRange {
    Index<Dim> low, high;
  };
  const auto range_of = [&](const Box<Dim>& box) {
    CellRange out;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      const double low = (box.low[axis] - lattice.origin[axis]) / lattice.spacing[axis] - round_off;
      const double high = (box.high[axis] - lattice.origin[axis]) / lattice.spacing[axis] + round_off;
      out.low[d] = static_cast<int>(std::floor(low)), out.high[d] = static_cast<int>(std::floor(high));
    }
    return out;
  };
  const auto cross = [&](const PlacedPiece& piece, const Index<Dim>& node, std::size_t axis) {
    const auto [list, local] = place_of(node);
    if (list < 0) return;
    Index<Dim> next = node;
    ++next[axis];
    if (crossing(piece.corners, lattice.position(node), lattice.position(next)) == 0) return;
    const auto at = static_cast<std::size_t>(list);
    crossings_[at].edges[local][axis] ^= bit_of(piece.surface, lists_[at]);
  };
  for (const PlacedPiece& piece : pieces_) {
    const CellRange range = range_of(piece.box);
    each_in_box<Dim>(range.low, range.high, [&](const Index<Dim>& cell) { extend_slab(cell, piece); });
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      Index<Dim> low = range.low;
      for (std::size_t d = 0; d < Dim; ++d)
        if (d != axis) ++low[d];  // the grid lines between the cells
      each_in_box<Dim>(low, range.high, [&](const Index<Dim>& node) { cross(piece, node, axis); });
    }
  }
}

// Bits of the surfaces that the segment crosses an odd number of times.
template <int Dim>
std::uint64_t Cracks<Dim>::crossed(const List& list, const Vec<Dim>& from, const Vec<Dim>& to) const {
  std::uint64_t out = 0;
  const SegmentTest<Dim> may_cross(from, to, round_off * system_.lattice.spacing.minCoeff());
  tree_.each(may_cross, [&](std::size_t first, std::size_t end) {
    for (std::size_t p = first; p < std::min(end, pieces_.size()); ++p) {
      const PlacedPiece& piece = pieces_[p];
      if (may_cross(piece.box) && crossing(piece.corners, from, to) != 0) out ^= bit_of(piece.surface, list);
    }
  });
  return out;
}

template <int Dim>
void Cracks<Dim>::find_box(const Index<Dim>& low, const Index<Dim>& high, const List& list, NodeBox& nodes) const {
  nodes.low = low, nodes.high = high, nodes.list = &list, nodes.step = step_;
  nodes.crossed.clear(), nodes.slabs.clear();
  nodes.is_cut = nodes.has_end = false;
  std::array<std::size_t, static_cast<std::size_t>(Dim)> stride;
  std::size_t count = 1;
  for (std::size_t d = 0; d < Dim; ++d) stride[d] = count, count *= static_cast<std::size_t>(high[d] - low[d] + 1);
  each_in_box<Dim>(low, high, [&](const Index<Dim>& node) {
    // from the node before along the highest axis on which there is one
    std::uint64_t bits = 0;
    for (std::size_t d = Dim; d-- > 0;) {
      if (node[d] == low[d]) continue;
      Index<Dim> before = node;
      --before[d];
      bits = nodes.crossed[nodes.crossed.size() - stride[d]];
      if (const auto [place, local] = place_of(before); place >= 0)
        bits ^= translated(crossings_[static_cast<std::size_t>(place)].edges[local][d],
                           lists_[static_cast<std::size_t>(place)], list);
      break;
    }
    const auto [place, local] = place_of(node);
    nodes.crossed.push_back(bits);
    const Slab* slab = nullptr;
    if (place >= 0)
      if (const BlockCrossings& block = crossings_[static_cast<std::size_t>(place)]; block.slab[local] >= 0)
        slab = &block.slabs[static_cast<std::size_t>(block.slab[local])];
    nodes.slabs.push_back(slab);
    nodes.is_cut = nodes.is_cut || bits != 0 || slab;
  });
  if (!nodes.is_cut) return;
  const Box<Dim> box{system_.lattice.position(low), system_.lattice.position(high)};
  end_tree_.each([&](const Box<Dim>& end) { return !nodes.has_end && end.overlaps(box); },
                 [&](std::size_t first, std::size_t last) {
                   for (std::size_t k = first; k < std::min(last, end_boxes_.size()); ++k)
                     nodes.has_end = nodes.has_end || end_boxes_[k].overlaps(box);
                 });
}

template <int Dim>
bool Cracks<Dim>::find_nodes(const Vec<Dim>& x, NodeBox& nodes) const {
  Index<Dim> low, high;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    const double s = (x[axis] - system_.lattice.origin[axis]) / system_.lattice.spacing[axis];
    constexpr double reach = 2.01;  // of all shape functions [cells]
    low[d] = static_cast<int>(std::ceil(s - reach)), high[d] = static_cast<int>(std::floor(s + reach));
  }
  const List& list = near(x);
  if (nodes.step == step_ && nodes.low == low && nodes.high == high && nodes.list == &list) return true;
  find_box(low, high, list, nodes);
  return false;
}

// Bits of the surfaces between the lowest node of a box and a point in a cell of it. Between the point and a corner of
// the cell on the same side of its slab there is no piece. Else the segment to the closest corner is tested.
template <int Dim>
std::uint64_t Cracks<Dim>::crossed_in_cell(const NodeBox& nodes, const Index<Dim>& cell, const Vec<Dim>& x) const {
  const Lattice<Dim>& lattice = system_.lattice;
  const Slab* const slab = nodes.slabs[nodes.at(cell)];
  if (!slab) return nodes.crossed[nodes.at(cell)];
  const double margin = round_off * lattice.spacing.minCoeff(), at = x.dot(slab->normal);
  Index<Dim> corner = cell;
  if (const int ahead = at > slab->high + margin ? 1 : at < slab->low - margin ? -1 : 0; ahead != 0) {
    for (std::size_t d = 0; d < Dim; ++d) corner[d] += ahead * slab->normal[static_cast<Eigen::Index>(d)] > 0 ? 1 : 0;
    const double of_corner = lattice.position(corner).dot(slab->normal);
    if (ahead > 0 ? of_corner > slab->high + margin : of_corner < slab->low - margin)
      return nodes.crossed[nodes.at(corner)];
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    corner[d] = cell[d] + (x[axis] - lattice.position(cell)[axis] > 0.5 * lattice.spacing[axis] ? 1 : 0);
  }
  return nodes.crossed[nodes.at(corner)] ^ crossed(*nodes.list, x, lattice.position(corner));
}

template <int Dim>
auto Cracks<Dim>::sides_of(const NodeBox& nodes, const Vec<Dim>& x) const -> PointSides {
  PointSides out{&nodes, x, nodes.is_cut && nodes.has_end, 0};
  Index<Dim> cell;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    const double s = (x[axis] - system_.lattice.origin[axis]) / system_.lattice.spacing[axis];
    cell[d] = std::clamp(static_cast<int>(std::floor(s)), nodes.low[d], nodes.high[d] - 1);
    out.by_segment = out.by_segment || s < nodes.low[d] || s > nodes.high[d];  // an edge may lie between the two
  }
  if (!out.by_segment && nodes.is_cut) out.crossed = crossed_in_cell(nodes, cell, x);
  return out;
}

template <int Dim>
std::uint64_t Cracks<Dim>::crossed(const PointSides& point, const Index<Dim>& node) const {
  if (point.by_segment) return crossed(*point.nodes->list, point.x, system_.lattice.position(node));
  return point.nodes->is_cut ? point.crossed ^ point.nodes->crossed[point.nodes->at(node)] : 0;
}

template <int Dim>
int Cracks<Dim>::side_of_node(const PointSides& point, const Index<Dim>& node) const {
  return side_from_crossings(node, crossed(point, node), *point.nodes->list);
}

// With one crack, a crossing gives the side directly. With several, number_node_surfaces() converts the crossings into
// sides.
template <int Dim>
void Cracks<Dim>::find_bin(Body<Dim>& body, const Bin& bin, CutBin& cut) {
  const std::uint32_t count = bin.end - bin.begin;
  cut.first.assign(count, -1);
  cut.sides.clear(), cut.crossed.clear();
  const bool several = system_.cracks.size() > 1;
  const int list = list_of_[system_.lattice.block_at(bin.block)];
  if (list < 0 || count == 0) return;
  const List& surfaces = lists_[static_cast<std::size_t>(list)];
  thread_local std::vector<Index<Dim>> lowest;
  thread_local NodeBox of_bin, of_particle;
  transfers_.lowest_nodes(body, system_.lattice, bin, lowest);
  const auto highest_of = [&](Index<Dim> low) {
    for (int& n : low) n += width_ - 1;
    return low;
  };
  Index<Dim> low = lowest[0], high = lowest[0];
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::size_t d = 0; d < Dim; ++d)
      low[d] = std::min(low[d], lowest[i][d]), high[d] = std::max(high[d], lowest[i][d]);
  find_box(low, highest_of(high), surfaces, of_bin);
  if (!of_bin.is_cut) return;
  for (std::uint32_t i = 0; i < count; ++i) {
    const NodeBox* nodes = &of_bin;
    if (of_bin.has_end) find_box(lowest[i], highest_of(lowest[i]), surfaces, of_particle), nodes = &of_particle;
    const PointSides point = sides_of(*nodes, body.particles.position(bin.begin + i));
    const std::size_t first = cut.sides.size();
    std::uint64_t any = 0;
    each_in_box<Dim>(lowest[i], highest_of(lowest[i]), [&](const Index<Dim>& node) {
      const std::uint64_t bits = crossed(point, node);
      any |= bits;
      cut.sides.push_back(bits != 0);
      if (several) cut.crossed.push_back(bits);
    });
    if (any != 0) {
      cut.first[i] = static_cast<std::int32_t>(first);
    } else {
      cut.sides.resize(first);
      if (several) cut.crossed.resize(first);
    }
  }
}

template class Cracks<2>;
template class Cracks<3>;

}  // namespace tribo
