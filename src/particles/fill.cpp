// SPDX-License-Identifier: MIT
#include "particles/fill.hpp"
#include "base/memory.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "materials/material.hpp"
#include "particles/coverage.hpp"
#include "particles/cut_sites.hpp"
#include "particles/geostatic.hpp"
#include "particles/seed_maker.hpp"
#include "particles/sites.hpp"

#include <cmath>

namespace tribo {
namespace {

// The number n with n^dimension = total, or none.
std::optional<int> root(int total, int dimension) {
  for (int n = 1; n <= 64; ++n) {
    const int power = dimension == 2 ? n * n : n * n * n;
    if (power == total) return n;
  }
  return std::nullopt;
}

// Exact volume of a piece (in two dimensions, area), if it is known and the piece is not cut by an earlier one or by
// the edge of the grid.
std::optional<double> exact_area(const Model& model, const GridBox& grid, std::size_t p) {
  const Piece& piece = model.pieces[p];
  bool whole = grid.holds(piece.region->bounds());
  for (std::size_t q = 0; q < p && whole && !piece.deformation; ++q)
    whole = model.pieces[q].deformation || !grid.overlap(piece.region->bounds(), model.pieces[q].region->bounds());
  return whole ? piece.region->measure() : std::nullopt;
}

class Filler {
 public:
  Filler(const Model& model, const std::function<void(const Seed&)>& receive, bool refuses_large)
      : model_(model), receive_(receive), refuses_large_(refuses_large), grid_(model), seeds_(model, grid_) {}

  void run() {
    choose_lattices();
    for (std::size_t p = 0; p < model_.pieces.size(); ++p)
      with_memory_for("the particles of this body", model_.pieces[p].origin, [&] { fill(p); });
    for (const auto& point : model_.points) receive_(seeds_.at(point, per_axis_));
    for (std::size_t t = 0; t < model_.tables.size(); ++t)
      with_memory_for("the particles of this table", model_.tables[t].origin, [&] {
        for (std::size_t row = 0; row < model_.tables[t].position.size(); ++row) receive_(seeds_.of_table(t, row));
      });
  }

 private:
  // Particles per cell along an axis, unless a piece specifies them.
  int default_per_axis() const {
    const int dimension = model_.dimension();
    const int total = model_.points_per_cell > 0 ? model_.points_per_cell : (dimension == 2 ? 4 : 8);
    const auto n = root(total, dimension);
    if (!n)
      throw InputError(model_.grid.origin, std::to_string(total) + " points per cell is not a " +
                                               (dimension == 2 ? "square: 1, 4, 9, 16, 25 ..." : "cube: 1, 8, 27 ..."));
    return *n;
  }

  std::array<int, 3> per_axis(const Piece& piece) const {
    std::array<int, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int wanted = piece.points_per_axis[k];
      if (wanted < 0 || wanted > 64)
        throw InputError(piece.origin, std::to_string(wanted) + " points per axis of a cell; valid: 1 to 64");
      n[k] = static_cast<int>(k) >= model_.dimension() ? 1 : (wanted > 0 ? wanted : per_axis_);
    }
    return n;
  }

  // Pieces with the same number of particles per cell share a lattice; holes need no lattice of their own.
  void choose_lattices() {
    per_axis_ = default_per_axis();
    for (std::size_t p = 0; p < model_.pieces.size(); ++p) {
      const Piece& piece = model_.pieces[p];
      lattice_of_.push_back(-1);
      if (piece.material < 0) continue;
      const Bounds reach = grid_.clip(piece.region->bounds());
      if (piece.point_size) {
        if (!(*piece.point_size > 0.0)) throw InputError(piece.origin, "the size of the points must be positive");
        lattices_.push_back(grid_.lattice(reach.low, *piece.point_size));
        lattice_of_.back() = static_cast<int>(lattices_.size()) - 1;
      } else {
        lattice_of_.back() = cell_lattice(per_axis(piece));
      }
      Sites& lattice = lattices_[static_cast<std::size_t>(lattice_of_.back())];
      if (refuses_large_) must_fit(piece, lattice, reach);
      lattice.extend(reach);
      lattice.last_piece = static_cast<int>(p);
    }
    for (std::size_t k = 0; k < lattices_.size(); ++k)
      if (!lattices_[k].allocate())
        throw InputError(model_.grid.origin, "the points are so small that there would be more than 4e9 sites");
  }

  // The fraction of a box that a shape fills, from a sequence of points of low discrepancy.
  static double filled(const Region& region, const Bounds& box) {
    static constexpr int tries = 4000;
    int inside = 0;
    for (int k = 1; k <= tries; ++k) {
      const auto part = [&](double step) { return k * step - std::floor(k * step); };
      const Vec3 at(part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703));
      inside += region.contains(box.low + at.cwiseProduct(box.high - box.low)) ? 1 : 0;
    }
    return (inside + 0.5) / tries;
  }

  // Refuses a body whose particles do not fit into the memory, before time is spent on them.
  void must_fit(const Piece& piece, const Sites& lattice, const Bounds& reach) {
    const Eigen::Index dimension = lattice.flat ? 2 : 3;
    const Vec3 extent = (reach.high - reach.low).cwiseMax(0.0);
    const double sites = extent.cwiseQuotient(lattice.spacing).head(dimension).prod();
    static constexpr double small = 1e6;
    const double bytes_per_particle = lattice.flat ? 240 : 330;  // with those of the run
    if (sites <= small) return;
    Bounds flat = reach;
    if (lattice.flat) flat.low[2] = flat.high[2] = 0.0;
    particles_ += sites * filled(*piece.region, flat);
    const double wanted = particles_ * bytes_per_particle, free = available_memory();
    if (wanted <= free) return;
    throw InputError(piece.origin, format("with this body the model has about %.2g particles, which need %.2g GB; this "
                                          "machine has %.2g GB free. Use larger cells or fewer particles per cell",
                                          particles_, 1e-9 * wanted, 1e-9 * free));
  }

  int cell_lattice(const std::array<int, 3>& n) {
    for (std::size_t k = 0; k < lattices_.size(); ++k)
      if (lattices_[k].of_cells && lattices_[k].per_cell == n) return static_cast<int>(k);
    lattices_.push_back(grid_.lattice(n));
    return static_cast<int>(lattices_.size()) - 1;
  }

  void fill(std::size_t p) {
    const Piece& piece = model_.pieces[p];
    const bool hole = piece.material < 0;
    if (piece.deformation && hole) throw InputError(piece.origin, "a hole cannot be deformed");
    if (!hole) seeds_.check_stress(piece);
    if (!hole && !seeds_.law(piece.material, piece.origin).rigid()) {
      for (const EdgeCut& cut : edge_cuts(model_, p))
        throw InputError(piece.origin, text_of(cut, model_) +
                                           "; enlarge <Grid>, or make this edge a symmetry plane (symmin, symmax)");
      if (const auto part = part_beyond_plane(model_, p))
        throw InputError(piece.origin, *part +
                                           ", where only the mirror image of the model is; draw the part inside, or "
                                           "move the plane (symmin, symmax) to its end");
    }
    const int own = lattice_of_[p];
    long count = 0;
    const Bounds reach = grid_.clip(piece.region->bounds());
    if (!hole) {
      Sites& lattice = lattices_[static_cast<std::size_t>(own)];
      const Seed pattern = seeds_.pattern(p, lattice.spacing);
      count =
          model_.whole_particles ? emit_whole(piece, pattern, lattice, reach) : emit_cut(p, pattern, lattice, reach);
      if (count == 0) throw InputError(piece.origin, no_points(piece, own));
    }
    if (!piece.deformation) take_from_others(p, own, reach);
  }

  // Emits a whole particle for each site in the shape. Returns their number.
  long emit_whole(const Piece& piece, const Seed& pattern, Sites& lattice, const Bounds& reach) {
    long count = 0;
    lattice.visit(reach, [&](const Vec3& x, std::size_t site) {
      if (!take(piece, lattice, x, site)) return;
      receive_(seeds_.at(piece, pattern, x));
      ++count;
    });
    return count;
  }

  // Whether a site belongs to the piece; then it is taken.
  bool take(const Piece& piece, Sites& lattice, const Vec3& x, std::size_t site) const {
    if (!piece.region->contains(x) || !grid_.contains(x)) return false;
    if (piece.deformation) return true;
    if (lattice.taken[site]) return false;
    return lattice.taken[site] = true;
  }

  // Emits the particles of the shape, those at its surface with the part of their cells inside. Returns their number.
  long emit_cut(std::size_t p, const Seed& pattern, Sites& lattice, const Bounds& reach) {
    const Piece& piece = model_.pieces[p];
    std::vector<bool> taken;
    lattice.visit(reach, [&](const Vec3& x, std::size_t site) { taken.push_back(take(piece, lattice, x, site)); });
    const Sites near = lattice.window(reach);
    std::vector<bool> centres(near.count(), false);
    std::size_t visited = 0;
    near.visit(reach, [&](const Vec3&, std::size_t site) { centres[site] = taken[visited++]; });
    const bool any = std::find(taken.begin(), taken.end(), true) != taken.end();
    const auto before = earlier_pieces(p);
    const auto inside = [&](const Vec3& x) {
      if (!piece.region->contains(x) || !grid_.contains(x)) return false;
      return std::none_of(before.begin(), before.end(), [&](const Region* region) { return region->contains(x); });
    };
    CutSites sites(near, reach, centres, inside, !any);
    if (const auto exact = exact_area(model_, grid_, p)) sites.scale_to(*exact);
    long count = 0;
    const double whole = lattice.spacing.head(lattice.flat ? 2 : 3).prod();
    near.visit(reach, [&](const Vec3& x, std::size_t site) {
      if (const CutCell* cell = sites.cut(site))
        receive_(seeds_.at(piece, seeds_.cut(pattern, *cell, whole), cell->centroid));
      else if (sites.is_whole(site))
        receive_(seeds_.at(piece, pattern, x));
      else
        return;
      ++count;
    });
    return count;
  }

  // The regions of earlier pieces and holes that may cover a part of a piece.
  std::vector<const Region*> earlier_pieces(std::size_t p) const {
    std::vector<const Region*> out;
    const Piece& piece = model_.pieces[p];
    if (piece.deformation) return out;
    for (std::size_t q = 0; q < p; ++q)
      if (!model_.pieces[q].deformation && grid_.overlap(piece.region->bounds(), model_.pieces[q].region->bounds()))
        out.push_back(model_.pieces[q].region.get());
    return out;
  }

  // Marks the sites of other lattices that lie in the shape as taken.
  void take_from_others(std::size_t p, int own, const Bounds& reach) {
    const Region& region = *model_.pieces[p].region;
    for (int k = 0; k < static_cast<int>(lattices_.size()); ++k) {
      Sites& lattice = lattices_[static_cast<std::size_t>(k)];
      if (k == own || lattice.last_piece <= static_cast<int>(p)) continue;
      lattice.visit(reach, [&](const Vec3& x, std::size_t site) {
        if (!lattice.taken[site] && region.contains(x)) lattice.taken[site] = true;
      });
    }
  }

  std::string no_points(const Piece& piece, int own) const {
    const Bounds b = piece.region->bounds();
    if (!grid_.overlaps(b))
      return "this body lies outside the grid: it extends from " + place(b.low) + " to " + place(b.high) +
             ", and the grid from " + place(grid_.low) + " to " + place(grid_.high);
    const Sites& lattice = lattices_[static_cast<std::size_t>(own)];
    return "this body gets no material point: it measures " + place(b.high - b.low) + ", and points are " +
           place(lattice.spacing) + " apart; it is smaller than that, or earlier bodies or holes cover it";
  }
  std::string place(const Vec3& x) const {
    return format("(%.4g, %.4g", x[0], x[1]) + (grid_.flat ? ")" : format(", %.4g)", x[2]));
  }

  const Model& model_;
  const std::function<void(const Seed&)>& receive_;
  bool refuses_large_;
  GridBox grid_;
  SeedMaker seeds_;
  int per_axis_ = 2;
  double particles_ = 0.0;  // estimated number in large bodies
  std::vector<Sites> lattices_;
  std::vector<int> lattice_of_;  // index of the lattice of each piece; -1 for holes
};

}  // namespace

// A function without a value is a mistake of the input here; the message begins with its place.
void place_points(const Model& model, const std::function<void(const Seed&)>& receive, bool refuses_large) {
  try {
    Filler(model, receive, refuses_large).run();
  } catch (const SimulationError& error) {
    throw InputError(Origin{}, error.what());
  }
}

Seeds place_points(const Model& model) {
  Seeds seeds;
  place_points(model, [&](const Seed& seed) { seeds.push_back(seed); });
  return with_geostatic_stress(model, std::move(seeds));
}

std::vector<PlacedVolume> volume_error(const Model& model, const Seeds& seeds) {
  const GridBox grid(model);
  std::vector<PlacedVolume> by_piece(model.pieces.size());
  for (const auto& seed : seeds) {
    if (seed.piece < 0) continue;
    auto& entry = by_piece.at(static_cast<std::size_t>(seed.piece));
    ++entry.points;
    entry.placed += seed.volume;
  }
  std::vector<PlacedVolume> out;
  for (std::size_t p = 0; p < model.pieces.size(); ++p) {
    const Piece& piece = model.pieces[p];
    if (piece.material < 0) continue;
    PlacedVolume entry = by_piece[p];
    entry.piece = static_cast<int>(p);
    if (model.analysis != Analysis::axisymmetric) entry.exact = exact_area(model, grid, p);
    if (entry.exact && model.dimension() == 2) *entry.exact *= piece.thickness.value_or(model.grid.thickness);
    out.push_back(entry);
  }
  return out;
}

}  // namespace tribo
