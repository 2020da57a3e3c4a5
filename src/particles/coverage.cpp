// SPDX-License-Identifier: MIT
#include "particles/coverage.hpp"

#include "base/text.hpp"
#include "particles/sites.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

/// Least and most numbers of points along an axis, in two and in three dimensions.
constexpr std::array<double, 2> flat_points{24, 384}, solid_points{8, 48};

// Calls f(x) for points of a box, about `per_cell` of them per cell and axis; irrational offsets keep them off the
// faces of shapes with round numbers. Returns the volume per point, in two dimensions the area.
template <class F>
double sample(const Bounds& box, const GridBox& grid, double per_cell, F&& f) {
  constexpr std::array offset{0.38196601, 0.61803399, 0.41421356};
  const int dimension = grid.flat ? 2 : 3;
  const auto& limits = grid.flat ? flat_points : solid_points;
  std::array<int, 3> count{1, 1, 1};
  Vec3 step = Vec3::Zero();
  double volume = 1.0;
  for (int k = 0; k < dimension; ++k) {
    const double size = box.high[k] - box.low[k];
    if (!(size > 0)) return 0.0;
    const auto d = static_cast<std::size_t>(k);
    count[d] = static_cast<int>(std::clamp(std::ceil(per_cell * size / grid.cell[k]), limits[0], limits[1]));
    step[k] = size / count[d], volume *= step[k];
  }
  for (int c = 0; c < count[2]; ++c)
    for (int b = 0; b < count[1]; ++b)
      for (int a = 0; a < count[0]; ++a) {
        Vec3 x = box.low + step.cwiseProduct(Vec3(a + offset[0], b + offset[1], c + offset[2]));
        if (grid.flat) x[2] = 0.0;
        f(x);
      }
  return volume;
}

// The bounds of a region; two-dimensional ones have no limits in z.
Bounds bounds_of(const Piece& piece, const GridBox& grid) {
  Bounds out = piece.region->bounds();
  if (grid.flat) out.low[2] = grid.low[2], out.high[2] = grid.high[2];
  return out;
}

// Whether a point of a piece belongs to an earlier one, or lies in a hole.
bool covered(const Model& model, std::size_t piece, const Vec3& x) {
  if (model.pieces[piece].deformation) return false;
  for (std::size_t q = 0; q < piece; ++q)
    if (!model.pieces[q].deformation && model.pieces[q].region->contains(x)) return true;
  return false;
}

// Whether a body may go on beyond an edge.
bool continues(const Model& model, int axis, int side) {
  const auto k = static_cast<std::size_t>(axis);
  if (model.analysis == Analysis::axisymmetric && axis == 0 && side == 0) return true;  // radii are positive
  return model.grid.periodic[k] || model.grid.symmetry[k][static_cast<std::size_t>(side)];
}

// Whether the piece goes on beyond an edge of the grid.
bool crosses(const Model& model, const GridBox& grid, std::size_t p, int axis, int side) {
  const Piece& piece = model.pieces[p];
  const Bounds body = bounds_of(piece, grid);
  const double edge = side == 0 ? grid.low[axis] : grid.high[axis], slack = 1e-6 * grid.cell[axis];
  const double beyond = side == 0 ? edge - body.low[axis] : body.high[axis] - edge;
  if (!(beyond > slack) || continues(model, axis, side)) return false;
  bool found = false;
  const auto look = [&](double from, double to) {
    Bounds slab = body;
    slab.low[axis] = side == 0 ? edge - to : edge + from;
    slab.high[axis] = side == 0 ? edge - from : edge + to;
    sample(slab, grid, 4,
           [&](const Vec3& x) { found = found || (piece.region->contains(x) && !covered(model, p, x)); });
  };
  look(0.5 * slack, std::min(beyond, 0.05 * grid.cell[axis]));  // the faces at the edge
  if (!found) look(0.5 * slack, beyond);                        // and parts that lie apart
  return found;
}

double lost_share(const Model& model, const GridBox& grid, std::size_t p) {
  double inside = 0, outside = 0;
  sample(bounds_of(model.pieces[p], grid), grid, 4, [&](const Vec3& x) {
    if (!model.pieces[p].region->contains(x) || covered(model, p, x)) return;
    (grid.contains(x) ? inside : outside) += 1;
  });
  return inside + outside > 0 ? outside / (inside + outside) : 0.0;
}

bool one_body(const Piece& a, const Piece& b) {
  return a.material == b.material && a.velocity == b.velocity && a.angle == b.angle;
}

}  // namespace

std::vector<EdgeCut> edge_cuts(const Model& model, std::size_t p) {
  const GridBox grid(model);
  if (model.pieces[p].material < 0 || !grid.overlaps(bounds_of(model.pieces[p], grid))) return {};
  for (int axis = 0; axis < model.dimension(); ++axis)
    for (int side = 0; side < 2; ++side)
      if (crosses(model, grid, p, axis, side)) return {{static_cast<int>(p), axis, side, lost_share(model, grid, p)}};
  return {};
}

std::vector<EdgeCut> edge_cuts(const Model& model) {
  std::vector<EdgeCut> out;
  for (std::size_t p = 0; p < model.pieces.size(); ++p)
    for (const EdgeCut& cut : edge_cuts(model, p)) out.push_back(cut);
  return out;
}

std::string text_of(const EdgeCut& cut, const Model& model) {
  constexpr std::string_view axes = "xyz";
  const auto k = static_cast<std::size_t>(cut.axis);
  const double edge = cut.side == 0 ? model.grid.low[k] : model.grid.high[k];
  const std::string share = cut.lost < 0.001   ? "less than 0.1 %"
                            : cut.lost < 0.995 ? format("%.2g %%", 100 * cut.lost)
                                               : "almost all";
  const Bounds body = bounds_of(model.pieces[static_cast<std::size_t>(cut.piece)], GridBox(model));
  const double lengths = (body.high - body.low)[cut.axis] / (model.grid.high[k] - model.grid.low[k]);
  return format("the edge of the grid at %c%s = %.6g cuts this body: %s of it lies outside", axes[k],
                cut.side == 0 ? "min" : "max", edge, share.c_str()) +
         (lengths > 10 && std::isfinite(lengths)
              ? format(". It is %.3g times as long as the grid: check its unit, or the scale of its file", lengths)
              : "");
}

std::optional<std::string> part_beyond_plane(const Model& model, std::size_t p) {
  const GridBox grid(model);
  const Piece& piece = model.pieces[p];
  if (piece.material < 0 || !grid.overlaps(bounds_of(piece, grid))) return std::nullopt;
  const Bounds body = grid.clip(bounds_of(piece, grid));
  for (int axis = 0; axis < model.dimension(); ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& plane = model.grid.symmetry[static_cast<std::size_t>(axis)][side];
      if (!plane) continue;
      const double slack = 1e-6 * grid.cell[axis];
      Bounds slab = body;
      (side == 0 ? slab.high : slab.low)[axis] = *plane;
      if (!(slab.high[axis] - slab.low[axis] > slack)) continue;
      bool found = false;
      sample(slab, grid, 4,
             [&](const Vec3& x) { found = found || (piece.region->contains(x) && !covered(model, p, x)); });
      const char name = "xyz"[axis];
      if (found)
        return format("this body has parts beyond the symmetry plane at %c%s = %.6g, up to %c = %.6g", name,
                      side == 0 ? "min" : "max", *plane, name, (side == 0 ? body.low : body.high)[axis]);
    }
  return std::nullopt;
}

std::vector<Overlap> overlaps(const Model& model) {
  constexpr double least = 0.1, whole = 0.99;
  const GridBox grid(model);
  const double cell = grid.flat ? grid.cell.head<2>().prod() : grid.cell.prod();
  std::vector<Overlap> out;
  for (std::size_t q = 0; q < model.pieces.size(); ++q)
    for (std::size_t p = 0; p < q; ++p) {
      const Piece &a = model.pieces[p], &b = model.pieces[q];
      if (a.material < 0 || b.material < 0 || a.deformation || b.deformation || one_body(a, b)) continue;
      const Bounds one = grid.clip(bounds_of(a, grid)), two = grid.clip(bounds_of(b, grid));
      if (!grid.overlap(one, two)) continue;
      const Bounds both{one.low.cwiseMax(two.low), one.high.cwiseMin(two.high)};
      double common = 0;
      const double unit = sample(both, grid, 4, [&](const Vec3& x) {
        common += a.region->contains(x) && b.region->contains(x) && !covered(model, p, x);
      });
      if (!(common * unit > least * cell)) continue;
      double own = 0, shared = 0;
      sample(one, grid, 4, [&](const Vec3& x) {
        if (!a.region->contains(x) || covered(model, p, x)) return;
        own += 1, shared += b.region->contains(x);
      });
      out.push_back({static_cast<int>(p), static_cast<int>(q), common * unit, shared > whole * own});
    }
  return out;
}

}  // namespace tribo
