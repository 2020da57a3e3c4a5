// SPDX-License-Identifier: MIT
#include "run/body_thickness.hpp"

#include "materials/material.hpp"
#include "particles/voxels.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace tribo {
namespace {

constexpr double thin = 2.75;  // cells
constexpr int enough = 3;      // cells; a thicker body is not measured
constexpr double infinity = std::numeric_limits<double>::infinity();

// The particles of a shape.
template <int Dim>
struct Extent {
  Vec<Dim> low = Vec<Dim>::Constant(infinity), high = Vec<Dim>::Constant(-infinity);
  int material = -1;
  void add(const Seed& seed) {
    low = low.cwiseMin((seed.x - seed.half_size).template head<Dim>());
    high = high.cwiseMax((seed.x + seed.half_size).template head<Dim>());
    material = seed.material;
  }
  double cells(const Vec<Dim>& spacing) const { return (high - low).cwiseQuotient(spacing).minCoeff(); }
};
template <int Dim>
using Extents = std::map<int, Extent<Dim>>;  // by shape

template <int Dim>
Extents<Dim> extents_of(const Model& model, const Seeds& seeds) {
  Extents<Dim> out;
  for (const Seed& seed : seeds)
    if (seed.piece >= 0 && !model.materials[static_cast<std::size_t>(seed.material)].law->rigid())
      out[seed.piece].add(seed);
  return out;
}

// The bodies that the shapes of one material form.
template <int Dim>
class Union {
 public:
  Union(const Model& model, const Seeds& seeds, const Lattice<Dim>& lattice, int material) : voxels_(model, lattice) {
    for (const Seed& seed : seeds)
      if (seed.material == material) voxels_.add(seed);
    voxels_.sort();
    voxels_.add_images(enough * Voxels<Dim>::per_cell);
    body_ = voxels_.connected();
    const std::vector<int> edges = voxels_.largest_cubes(enough * Voxels<Dim>::per_cell);
    for (std::size_t k = 0; k < edges.size(); ++k) edge_[body_[k]] = std::max(edge_[body_[k]], edges[k]);
    for (const Seed& seed : seeds)
      if (seed.material == material && seed.piece >= 0)
        if (const auto cube = voxels_.cube_around(seed.x.template head<Dim>()))
          bodies_[seed.piece].insert(body_[*cube]);
  }

  /// The shapes that form a body, for each of the bodies; a shape of several parts connects them.
  std::vector<ThinBody> bodies() const {
    std::vector<std::pair<ThinBody, std::set<std::size_t>>> groups;
    for (const auto& [piece, parts] : bodies_) {
      std::pair<ThinBody, std::set<std::size_t>> group{{{piece}, 0.0}, parts};
      for (auto other = groups.begin(); other != groups.end();) {
        const auto& theirs = other->second;
        if (std::none_of(theirs.begin(), theirs.end(), [&](std::size_t p) { return group.second.count(p) > 0; })) {
          ++other;
          continue;
        }
        group.first.pieces.insert(group.first.pieces.begin(), other->first.pieces.begin(), other->first.pieces.end());
        group.second.insert(theirs.begin(), theirs.end());
        other = groups.erase(other);
      }
      groups.push_back(std::move(group));
    }
    std::vector<ThinBody> out;
    for (auto& group : groups) {
      for (const std::size_t part : group.second)
        group.first.cells = std::max(group.first.cells, edge_.at(part) / double{Voxels<Dim>::per_cell});
      out.push_back(std::move(group.first));
    }
    return out;
  }

 private:
  Voxels<Dim> voxels_;
  std::vector<std::size_t> body_;                // of each cube
  std::map<std::size_t, int> edge_;              // of the largest cube in each of them
  std::map<int, std::set<std::size_t>> bodies_;  // of each shape
};

}  // namespace

template <int Dim>
std::vector<ThinBody> thin_bodies(const Model& model, const Seeds& seeds, const Lattice<Dim>& lattice) {
  const Extents<Dim> extents = extents_of<Dim>(model, seeds);
  std::set<int> materials;  // with a thin shape
  for (const auto& entry : extents)
    if (entry.second.cells(lattice.spacing) <= thin) materials.insert(entry.second.material);
  std::vector<ThinBody> out;
  for (const int material : materials)
    for (ThinBody& body : Union<Dim>(model, seeds, lattice, material).bodies()) {
      double extent = 0.0;
      for (const int piece : body.pieces) extent = std::max(extent, extents.at(piece).cells(lattice.spacing));
      if (extent > thin || body.cells > thin) continue;
      const bool images = body.pieces.size() == 1 && body.cells > extent + 0.5;
      body.cells = body.pieces.size() == 1 && !images ? extent : std::max(body.cells, extent);
      out.push_back(std::move(body));
    }
  return out;
}

template std::vector<ThinBody> thin_bodies<2>(const Model&, const Seeds&, const Lattice<2>&);
template std::vector<ThinBody> thin_bodies<3>(const Model&, const Seeds&, const Lattice<3>&);

}  // namespace tribo
