// SPDX-License-Identifier: MIT
#include "particles/geostatic.hpp"

#include "base/error.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tribo {
namespace {

// The domain of a particle as an axis-parallel box, and its weight per volume.
struct Block {
  Vec3 centre, half;
  double unit_weight;  // [force/length^3]
};

// Axis parallel to gravity; 3 if there is none.
int vertical_axis(const Vec3& gravity) {
  int axis = 0;
  const double most = gravity.cwiseAbs().maxCoeff(&axis);
  return most > 0 && std::abs(gravity.norm() - most) < 1e-12 * most ? axis : 3;
}

// Boxes sorted by the vertical columns of grid cells that they overlap.
class Columns {
 public:
  Columns(const Model& model, int vertical) : model_(model) {
    for (int d = 0; d < model.dimension(); ++d)
      if (d != vertical) across_.push_back(d);
  }

  void add(const Block& block) {
    std::vector<std::vector<long>> at(1);
    for (const int d : across_) {
      std::vector<std::vector<long>> longer;
      for (long k = column(block.centre[d] - block.half[d], d); k <= column(block.centre[d] + block.half[d], d); ++k)
        for (auto key : at) key.push_back(k), longer.push_back(key);
      at = longer;
    }
    for (const auto& key : at) blocks_[key].push_back(block);
  }

  /// Weight per area above x, along the vertical line through x. `up`: direction (1 or -1) along the vertical axis.
  double weight_above(const Vec3& x, int vertical, double up) const {
    std::vector<long> key;
    for (const int d : across_) key.push_back(column(x[d], d));
    const auto found = blocks_.find(key);
    if (found == blocks_.end()) return 0.0;
    double sum = 0.0;
    for (const Block& b : found->second) {
      const double top = up * (b.centre[vertical] - x[vertical]) + b.half[vertical];
      const double height = std::clamp(top, 0.0, 2 * b.half[vertical]);
      if (height > 0) sum += share(b, x) * height * b.unit_weight;
    }
    return sum;
  }

 private:
  long column(double x, int d) const {
    const auto axis = static_cast<std::size_t>(d);
    const double cell = (model_.grid.high[d] - model_.grid.low[d]) / model_.grid.cells[axis];
    return std::lround(std::floor((x - model_.grid.low[d]) / cell));
  }

  // Fraction with which a box counts on the vertical line through x: 1/2 if the line runs along a side of the box.
  double share(const Block& b, const Vec3& x) const {
    double share = 1.0;
    for (const int d : across_) {
      const double inside = 1 - std::abs(x[d] - b.centre[d]) / b.half[d];
      share *= inside > 1e-9 ? 1.0 : inside > -1e-9 ? 0.5 : 0.0;
    }
    return share;
  }

  const Model& model_;
  std::vector<int> across_;
  std::map<std::vector<long>, std::vector<Block>> blocks_;
};

}  // namespace

Seeds with_geostatic_stress(const Model& model, Seeds seeds) {
  const auto piece_of = [&](const Seed& s) {
    return s.piece < 0 ? nullptr : &model.pieces[static_cast<std::size_t>(s.piece)];
  };
  const auto first =
      std::find_if(model.pieces.begin(), model.pieces.end(), [](const Piece& p) { return p.K0.has_value(); });
  if (first == model.pieces.end()) return seeds;
  const Vec3& gravity = model.body_force.gravity;
  const int vertical = vertical_axis(gravity);
  if (vertical >= model.dimension())
    throw InputError(
        first->origin,
        "the geostatic stress (K0) needs gravity along an axis of the grid, by <BodyXForce>, <BodyYForce> or "
        "<BodyZForce>");
  Columns columns(model, vertical);
  for (const Seed& s : seeds) {
    if (model.materials[static_cast<std::size_t>(s.material)].law->rigid()) continue;
    columns.add({s.x, s.F.cwiseAbs() * s.half_size, s.mass / (s.volume * s.F.determinant()) * gravity.norm()});
  }
  const double up = gravity[vertical] < 0 ? 1.0 : -1.0;
  Seeds out;
  for (Seed s : seeds) {
    if (const Piece* piece = piece_of(s); piece && piece->K0) {
      const double stress = -columns.weight_above(s.x, vertical, up);
      for (int d = 0; d < 3; ++d) s.stress(d, d) += d == vertical ? stress : *piece->K0 * stress;
    }
    out.push_back(s);
  }
  return out;
}

}  // namespace tribo
