// SPDX-License-Identifier: MIT
#include "solver/cracks/cracks.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace tribo {

template <int Dim>
Cracks<Dim>::Cracks(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers)
    : model_(model),
      system_(system),
      transfers_(transfers),
      width_(transfers.stencil_width()),
      nodes_around_(model, system.lattice) {}

namespace {

template <int Dim>
Box<Dim> box_of(const std::array<Vec<Dim>, static_cast<std::size_t>(Dim)>& corners) {
  Box<Dim> box{corners[0], corners[0]};
  for (const auto& corner : corners) box.low = box.low.cwiseMin(corner), box.high = box.high.cwiseMax(corner);
  return box;
}

// Calls f(box, first, end) for ranges of items that follow each other in a box smaller than `size` [length], so that
// the many short pieces of a fine crack are treated together. A larger item is alone.
template <class BoxOf, class F>
void each_group(std::size_t count, double size, BoxOf&& box_of_item, F&& f) {
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    auto box = box_of_item(first);
    for (end = first + 1; end < count; ++end) {
      const auto next = box_of_item(end);
      auto both = box;
      both.low = box.low.cwiseMin(next.low), both.high = box.high.cwiseMax(next.high);
      if ((both.high - both.low).maxCoeff() > size) break;
      box = both;
    }
    f(box, first, end);
  }
}

// Calls f(block) for all blocks of a lattice that intersect a box.
template <int Dim, class F>
void each_block(const Lattice<Dim>& lattice, const Vec<Dim>& low, const Vec<Dim>& high, F&& f) {
  each_in_box<Dim>(lattice.block_of(low), lattice.block_of(high), [&](const Index<Dim>& block) { f(block); });
}

// Extends a box of blocks to all those that a box in space intersects.
template <int Dim>
void include_blocks(const Lattice<Dim>& lattice, const Vec<Dim>& low, const Vec<Dim>& high, BlockBox<Dim>& box) {
  box.include(lattice.block_of(low)), box.include(lattice.block_of(high));
}

}  // namespace

// Calls f for the images of a piece near symmetry planes and their images, so that a crack that ends on a plane
// continues beyond it.
template <int Dim>
template <class F>
void Cracks<Dim>::each_image(const PlacedPiece& piece, F&& f) const {
  if (nodes_around_.planes().empty()) return;
  std::vector<PlacedPiece> images{piece};
  for (std::size_t k = 0; k < images.size(); ++k)
    for (const SymmetryPlane& plane : nodes_around_.planes()) {
      PlacedPiece image = images[k];
      for (auto& corner : image.corners) corner[plane.axis] = 2 * plane.at - corner[plane.axis];
      std::swap(image.corners[0], image.corners[1]), std::swap(image.points[0], image.points[1]);
      image.box = box_of<Dim>(image.corners);
      const double h = system_.lattice.spacing[plane.axis];
      const double beyond =
          plane.inward > 0 ? plane.at - image.box.high[plane.axis] : image.box.low[plane.axis] - plane.at;
      const bool known = std::any_of(images.begin(), images.end(), [&](const PlacedPiece& other) {
        return (other.box.low - image.box.low).norm() + (other.box.high - image.box.high).norm() < 1e-9 * h;
      });
      if (beyond >= -1e-9 * h && beyond <= (width_ + 1.0) * h && !known) images.push_back(image);
    }
  for (std::size_t k = 1; k < images.size(); ++k) f(images[k]);
}

// The surfaces of some pieces with a common box are listed at every block that may contain an end of a segment that
// crosses them.
template <int Dim>
void Cracks<Dim>::list_surfaces(const Box<Dim>& box, std::size_t first, std::size_t end) {
  const Vec<Dim> reach = list_reach();
  each_block<Dim>(system_.lattice, box.low - reach, box.high + reach, [&](const Index<Dim>& block) {
    int& list = list_of_.at(block);
    if (list < 0) {
      list = static_cast<int>(listed_.size());
      listed_.push_back(block);
      if (lists_.size() < listed_.size()) lists_.emplace_back();
    }
    List& here = lists_[static_cast<std::size_t>(list)];
    for (std::size_t p = first; p < end; ++p)
      if (std::find(here.begin(), here.end(), pieces_[p].surface) == here.end()) here.push_back(pieces_[p].surface);
    if (here.size() > 64)
      throw SimulationError("more than 64 cracks come near one block of cells; use a finer grid or fewer cracks");
  });
}

template <int Dim>
void Cracks<Dim>::register_pieces() {
  for (auto& list : lists_) list.clear();
  listed_.clear();
  std::size_t count = 0;
  for (const auto& crack : system_.cracks) count += crack.pieces.size();
  pieces_.resize(count);
  constexpr std::ptrdiff_t worth_threads = 1000;  // pieces
  std::size_t first = 0;
  for (std::uint32_t c = 0; c < system_.cracks.size(); ++c) {
    const Crack<Dim>& crack = system_.cracks[c];
    parallel_for(
        static_cast<std::ptrdiff_t>(crack.pieces.size()),
        [&](std::ptrdiff_t k) {
          const auto p = static_cast<std::size_t>(k);
          const auto corners = crack.corners(p);
          pieces_[first + p] = {c,       static_cast<std::uint32_t>(p), crack.surface, crack.pieces[p],
                                corners, box_of<Dim>(corners)};
        },
        worth_threads);
    first += crack.pieces.size();
  }
  for (std::size_t p = 0; p < count; ++p)
    each_image(pieces_[p], [&](const PlacedPiece& image) { pieces_.push_back(image); });
  tree_.build(pieces_.size(), [&](std::size_t p) { return pieces_[p].box; });
  BlockBox<Dim> blocks;
  const Vec<Dim> reach = list_reach();
  for (const auto& piece : pieces_)
    include_blocks<Dim>(system_.lattice, piece.box.low - reach, piece.box.high + reach, blocks);
  list_of_.reset(blocks);
  each_group(
      pieces_.size(), system_.lattice.spacing.minCoeff(), [&](std::size_t p) { return pieces_[p].box; },
      [&](const Box<Dim>& box, std::size_t from, std::size_t end) { list_surfaces(box, from, end); });
}

template <int Dim>
auto Cracks<Dim>::near(const Vec<Dim>& x) const -> const List& {
  const int list = list_of_[system_.lattice.block_of(x)];
  return list >= 0 ? lists_[static_cast<std::size_t>(list)] : none_;
}

// The margin includes the motion between two sorts, since particles and cracks then move by less than a cell.
template <int Dim>
void Cracks<Dim>::locate() {
  if (!active()) return;
  const Vec<Dim> reach = (width_ + 4.0) * system_.lattice.spacing;
  BlockBox<Dim> blocks;
  for (const auto& crack : system_.cracks)
    for (const auto& x : crack.x) include_blocks<Dim>(system_.lattice, x - reach, x + reach, blocks);
  BlockFlags<Dim> cut(0);
  cut.reset(blocks);
  for (const auto& crack : system_.cracks)
    each_group(
        crack.pieces.size(), system_.lattice.spacing.minCoeff(),
        [&](std::size_t p) { return box_of<Dim>(crack.corners(p)); },
        [&](const Box<Dim>& box, std::size_t, std::size_t) {
          each_block<Dim>(system_.lattice, box.low - reach, box.high + reach,
                          [&](const Index<Dim>& block) { cut.at(block) = 1; });
        });
  cut_.clear();
  for (auto& body : system_.bodies) {
    const auto bins = body.bins.with_ghosts();
    body.cut.assign(bins.size(), -1);
    std::size_t count = 0;
    for (std::size_t b = 0; b < bins.size(); ++b) {
      if (cut[system_.lattice.block_at(bins[b].block)] == 0) continue;
      body.cut[b] = static_cast<std::int32_t>(count++);
      cut_.push_back({&body, b});
    }
    body.cut_bins.resize(count);
  }
}

template <int Dim>
void Cracks<Dim>::add_blocks(const Field<Dim>& field, std::vector<BlockReach<Dim>>& blocks) const {
  for (const auto& cut : cut_)
    if (cut.body->field == field.base_field)
      blocks.push_back(BlockReach<Dim>::full(cut.body->bins.with_ghosts()[cut.bin].block));
}

template <int Dim>
void Cracks<Dim>::find() {
  if (!active()) return;
  static std::atomic<std::uint64_t> steps{0};  // of all models of the process
  step_ = ++steps;
  register_pieces();
  find_ends();
  find_edge_crossings();
  parallel_for(static_cast<std::ptrdiff_t>(cut_.size()), [&](std::ptrdiff_t k) {
    const CutBinPlace& at = cut_[static_cast<std::size_t>(k)];
    auto& cut = at.body->cut_bins[static_cast<std::size_t>(at.body->cut[at.bin])];
    find_bin(*at.body, at.body->bins.with_ghosts()[at.bin], cut);
  });
  if (system_.cracks.size() > 1) number_node_surfaces();
}

template <int Dim>
std::int64_t Cracks<Dim>::flat(const Index<Dim>& node) const {
  std::int64_t n = 0;
  for (std::size_t d = Dim; d-- > 0;) n = n * system_.lattice.blocks[d] * block_edge<Dim> + node[d];
  return n;
}

// Of the surfaces between a node and its particles, the two with the lowest numbers define the fields of the node;
// further surfaces have no effect there.
template <int Dim>
void Cracks<Dim>::number_node_surfaces() {
  constexpr int none = -1;
  node_surfaces_.clear();
  const int nodes = Dim == 2 ? width_ * width_ : width_ * width_ * width_;
  std::vector<Index<Dim>> lowest;
  const auto each = [&](auto&& f) {
    for (const auto& at : cut_) {
      auto& cut = at.body->cut_bins[static_cast<std::size_t>(at.body->cut[at.bin])];
      if (cut.sides.empty()) continue;
      const Bin& bin = at.body->bins.with_ghosts()[at.bin];
      const List& list = lists_[static_cast<std::size_t>(list_of_[system_.lattice.block_at(bin.block)])];
      transfers_.lowest_nodes(*at.body, system_.lattice, bin, lowest);
      for (std::size_t i = 0; i < cut.first.size(); ++i)
        for (int n = 0; cut.first[i] >= 0 && n < nodes; ++n) {
          const auto k = static_cast<std::size_t>(cut.first[i] + n);
          if (cut.sides[k] == 0) continue;
          Index<Dim> node = lowest[i];
          node[0] += n % width_, node[1] += n / width_ % width_;
          if constexpr (Dim == 3) node[2] += n / (width_ * width_);
          f(node, cut.crossed[k], list, cut.sides[k]);
        }
    }
  };
  each([&](const Index<Dim>& node, std::uint64_t bits, const List& list, std::uint8_t&) {
    auto& [first, second] = node_surfaces_.try_emplace(flat(node), std::array{none, none}).first->second;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const int c = static_cast<int>(list[k]);
      if (!(bits >> k & 1) || c == first || c == second) continue;
      if (first == none || c < first)
        second = first, first = c;
      else if (second == none || c < second)
        second = c;
    }
  });
  each([&](const Index<Dim>& node, std::uint64_t bits, const List& list, std::uint8_t& side) {
    side = static_cast<std::uint8_t>(side_from_crossings(node, bits, list));
  });
}

template <int Dim>
int Cracks<Dim>::side_from_crossings(const Index<Dim>& node, std::uint64_t crossed, const List& list) const {
  if (system_.cracks.size() == 1 || crossed == 0) return crossed != 0 ? 1 : 0;
  const auto found = node_surfaces_.find(flat(node));
  // No particle of this node lies beyond a surface that does not define its fields: the side has no mass there.
  constexpr int no_particles = 1, no_particles_beyond_first = 2;
  if (found == node_surfaces_.end()) return no_particles;
  const auto [first, second] = found->second;
  int out = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!(crossed >> k & 1)) continue;
    const int number = static_cast<int>(list[k]);
    out |= number == first ? 1 : number == second ? 2 : second < 0 ? no_particles_beyond_first : 0;
  }
  return out;
}

template class Cracks<2>;
template class Cracks<3>;

}  // namespace tribo
