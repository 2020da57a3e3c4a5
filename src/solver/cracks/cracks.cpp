// SPDX-License-Identifier: MIT
#include "solver/cracks/cracks.hpp"

#include "base/parallel.hpp"
#include "geometry/crossing.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
Cracks<Dim>::Cracks(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers)
    : model_(model),
      system_(system),
      transfers_(transfers),
      width_(transfers.stencil_width()),
      nodes_around_(model, system.lattice),
      list_of_(active() ? static_cast<std::size_t>(system_.lattice.block_count()) : 0, -1) {}

namespace {

// Calls f(block) for all blocks of a lattice that intersect a box.
template <int Dim, class F>
void each_block(const Lattice<Dim>& lattice, const Vec<Dim>& low, const Vec<Dim>& high, F&& f) {
  each_in_box<Dim>(lattice.block_of(low), lattice.block_of(high),
                   [&](const Index<Dim>& block) { f(lattice.block_index(block)); });
}

}  // namespace

// Calls f for a piece and, near symmetry planes, for its images and their images, so that a crack that ends on a plane
// continues beyond it.
template <int Dim>
template <class F>
void Cracks<Dim>::each_image(const PlacedPiece& piece, F&& f) const {
  std::vector<PlacedPiece> images{piece};
  for (std::size_t k = 0; k < images.size(); ++k)
    for (const SymmetryPlane& plane : nodes_around_.planes()) {
      PlacedPiece image = images[k];
      for (auto& corner : image.corners) corner[plane.axis] = 2 * plane.at - corner[plane.axis];
      image.mirror[plane.axis] *= -1;
      std::swap(image.corners[0], image.corners[1]), std::swap(image.points[0], image.points[1]);
      image.low = image.high = image.corners[0];
      for (const auto& corner : image.corners)
        image.low = image.low.cwiseMin(corner), image.high = image.high.cwiseMax(corner);
      const double h = system_.lattice.spacing[plane.axis];
      const double beyond = plane.inward > 0 ? plane.at - image.high[plane.axis] : image.low[plane.axis] - plane.at;
      const bool known = std::any_of(images.begin(), images.end(), [&](const PlacedPiece& other) {
        return (other.low - image.low).norm() + (other.high - image.high).norm() < 1e-9 * h;
      });
      if (beyond >= -1e-9 * h && beyond <= (width_ + 1.0) * h && !known) images.push_back(image);
    }
  for (const PlacedPiece& image : images) f(image);
}

// A piece is listed at every block that may contain an end of a segment that crosses it.
template <int Dim>
void Cracks<Dim>::register_piece(const PlacedPiece& piece) {
  const Vec<Dim> reach = (width_ + 1.0) * system_.lattice.spacing;
  each_block<Dim>(system_.lattice, piece.low - reach, piece.high + reach, [&](std::int64_t block) {
    int& list = list_of_[static_cast<std::size_t>(block)];
    if (list < 0) {
      list = static_cast<int>(listed_.size());
      listed_.push_back(block);
      if (lists_.size() < listed_.size()) lists_.emplace_back();
    }
    List& here = lists_[static_cast<std::size_t>(list)];
    const auto found = std::find(here.surfaces.begin(), here.surfaces.end(), piece.surface);
    const auto bit = static_cast<std::uint32_t>(found - here.surfaces.begin());
    if (found == here.surfaces.end()) here.surfaces.push_back(piece.surface);
    if (here.surfaces.size() > 64)
      throw SimulationError("more than 64 cracks come near one block of cells; use a finer grid or fewer cracks");
    here.pieces.push_back(piece);
    here.pieces.back().bit = bit;
  });
}

template <int Dim>
void Cracks<Dim>::register_pieces() {
  for (const auto block : listed_) list_of_[static_cast<std::size_t>(block)] = -1;
  listed_.clear();
  for (auto& list : lists_) list.pieces.clear(), list.surfaces.clear();
  for (std::uint32_t c = 0; c < system_.cracks.size(); ++c) {
    const Crack<Dim>& crack = system_.cracks[c];
    for (std::size_t p = 0; p < crack.pieces.size(); ++p) {
      PlacedPiece piece{
          c, static_cast<std::uint32_t>(p), crack.surface, 0, crack.pieces[p], crack.corners(p), Vec<Dim>::Ones(), {},
          {}};
      piece.low = piece.high = piece.corners[0];
      for (const auto& corner : piece.corners)
        piece.low = piece.low.cwiseMin(corner), piece.high = piece.high.cwiseMax(corner);
      each_image(piece, [&](const PlacedPiece& image) { register_piece(image); });
    }
  }
}

template <int Dim>
auto Cracks<Dim>::near(const Vec<Dim>& x) const -> const List& {
  const List* found = &none_;
  each_block<Dim>(system_.lattice, x, x, [&](std::int64_t block) {
    const int list = list_of_[static_cast<std::size_t>(block)];
    if (list >= 0) found = &lists_[static_cast<std::size_t>(list)];
  });
  return *found;
}

// The margin includes the motion between two sorts, since particles and cracks then move by less than a cell.
template <int Dim>
void Cracks<Dim>::locate() {
  if (!active()) return;
  std::vector<char> cut(list_of_.size(), 0);
  const Vec<Dim> reach = (width_ + 4.0) * system_.lattice.spacing;
  for (const auto& crack : system_.cracks)
    for (std::size_t p = 0; p < crack.pieces.size(); ++p) {
      const auto corners = crack.corners(p);
      Vec<Dim> low = corners[0], high = low;
      for (const auto& corner : corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
      each_block<Dim>(system_.lattice, low - reach, high + reach,
                      [&](std::int64_t block) { cut[static_cast<std::size_t>(block)] = 1; });
    }
  cut_.clear();
  for (auto& body : system_.bodies) {
    const auto& bins = body.bins.list();
    body.cut.assign(bins.size(), -1);
    std::size_t count = 0;
    for (std::size_t b = 0; b < bins.size(); ++b) {
      if (!cut[static_cast<std::size_t>(bins[b].block)]) continue;
      body.cut[b] = static_cast<std::int32_t>(count++);
      cut_.push_back({&body, b});
    }
    body.cut_bins.resize(count);
  }
}

template <int Dim>
void Cracks<Dim>::add_blocks(const Field<Dim>& field, std::vector<std::int64_t>& blocks) const {
  for (const auto& cut : cut_)
    if (cut.body->field == field.base_field) blocks.push_back(cut.body->bins.list()[cut.bin].block);
}

template <int Dim>
void Cracks<Dim>::find() {
  if (!active()) return;
  register_pieces();
  parallel_for(static_cast<std::ptrdiff_t>(cut_.size()), [&](std::ptrdiff_t k) {
    const CutBinPlace& at = cut_[static_cast<std::size_t>(k)];
    auto& cut = at.body->cut_bins[static_cast<std::size_t>(at.body->cut[at.bin])];
    find_bin(*at.body, at.body->bins.list()[at.bin], cut);
  });
  if (system_.cracks.size() > 1) number_node_surfaces();
}

// Bits of the surfaces that the segment crosses an odd number of times.
template <int Dim>
std::uint64_t Cracks<Dim>::crossed(const std::vector<const PlacedPiece*>& pieces, const Vec<Dim>& from,
                                   const Vec<Dim>& to) const {
  std::uint64_t out = 0;
  const Vec<Dim> low = from.cwiseMin(to), high = from.cwiseMax(to);
  for (const PlacedPiece* p : pieces)
    if ((p->low.array() <= high.array()).all() && (low.array() <= p->high.array()).all() &&
        crossing(p->corners, from, to) != 0)
      out ^= std::uint64_t{1} << p->bit;
  return out;
}

// With one crack, a crossing gives the side directly. With several, number_node_surfaces() converts the crossings into
// sides.
template <int Dim>
void Cracks<Dim>::find_bin(Body<Dim>& body, const Bin& bin, CutBin& cut) {
  const std::uint32_t count = bin.end - bin.begin;
  cut.first.assign(count, -1);
  cut.sides.clear(), cut.crossed.clear();
  const bool several = system_.cracks.size() > 1;
  const int list = list_of_[static_cast<std::size_t>(bin.block)];
  if (list < 0) return;
  thread_local std::vector<Index<Dim>> lowest;
  thread_local std::vector<const PlacedPiece*> close;
  transfers_.lowest_nodes(body, system_.lattice, bin, lowest);
  const int nodes = Dim == 2 ? width_ * width_ : width_ * width_ * width_;
  const Vec<Dim> span = (width_ - 1.0) * system_.lattice.spacing;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec<Dim> x = body.particles.position(bin.begin + i), base = system_.lattice.position(lowest[i]);
    const Vec<Dim> low = base.cwiseMin(x), high = (base + span).cwiseMax(x);
    close.clear();
    for (const PlacedPiece& p : lists_[static_cast<std::size_t>(list)].pieces)
      if ((p.low.array() <= high.array()).all() && (low.array() <= p.high.array()).all()) close.push_back(&p);
    if (close.empty()) continue;
    const std::size_t first = cut.sides.size();
    bool any = false;
    for (int n = 0; n < nodes; ++n) {
      Index<Dim> node = lowest[i];
      node[0] += n % width_, node[1] += n / width_ % width_;
      if constexpr (Dim == 3) node[2] += n / (width_ * width_);
      const std::uint64_t bits = crossed(close, x, system_.lattice.position(node));
      any = any || bits != 0;
      cut.sides.push_back(bits != 0);
      if (several) cut.crossed.push_back(bits);
    }
    if (any) {
      cut.first[i] = static_cast<std::int32_t>(first);
    } else {
      cut.sides.resize(first);
      if (several) cut.crossed.resize(first);
    }
  }
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
      const Bin& bin = at.body->bins.list()[at.bin];
      const List& list = lists_[static_cast<std::size_t>(list_of_[static_cast<std::size_t>(bin.block)])];
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
    for (std::size_t k = 0; k < list.surfaces.size(); ++k) {
      const int c = static_cast<int>(list.surfaces[k]);
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
  for (std::size_t k = 0; k < list.surfaces.size(); ++k) {
    if (!(crossed >> k & 1)) continue;
    const int number = static_cast<int>(list.surfaces[k]);
    out |= number == first ? 1 : number == second ? 2 : second < 0 ? no_particles_beyond_first : 0;
  }
  return out;
}

template <int Dim>
void Cracks<Dim>::find_nearby(const Vec<Dim>& x, NearbyPieces& nearby) const {
  nearby.list = &near(x);
  nearby.close.clear();
  const Vec<Dim> reach = 2.01 * system_.lattice.spacing;
  const Vec<Dim> low = x - reach, high = x + reach;
  for (const PlacedPiece& p : nearby.list->pieces)
    if ((p.low.array() <= high.array()).all() && (low.array() <= p.high.array()).all()) nearby.close.push_back(&p);
}

template <int Dim>
int Cracks<Dim>::side_of_node(const NearbyPieces& nearby, const Vec<Dim>& x, const Index<Dim>& node) const {
  return nearby.close.empty()
             ? 0
             : side_from_crossings(node, crossed(nearby.close, x, system_.lattice.position(node)), *nearby.list);
}

template class Cracks<2>;
template class Cracks<3>;

}  // namespace tribo
