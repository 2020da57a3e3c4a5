// SPDX-License-Identifier: MIT
#include "solver/later_particles.hpp"

#include <cmath>
#include <numeric>

namespace tribo {
namespace {

// The particles of a source that enter together, with their centres on the plane of the inlet.
std::vector<Seed> row_of(const Model& model, const SourceSpec& source) {
  const bool plane = model.dimension() == 2;
  const Vec3& n = source.direction;
  // In space the flow is along an axis. The width is along y and the depth along z for a flow along x, else the width
  // is along x, and the depth along the remaining axis.
  const bool along_x = std::abs(n[0]) > 0.5, along_z = std::abs(n[2]) > 0.5;
  const Vec3 first = plane ? Vec3(n[1], -n[0], 0) : along_x ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX());
  const Vec3 second = plane ? Vec3(Vec3::Zero()) : along_z ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  std::vector<Seed> out;
  for (int j = 0; j < source.count[1]; ++j)
    for (int i = 0; i < source.count[0]; ++i) {
      Seed seed;
      seed.material = source.material;
      seed.x = source.centre + (i + 0.5 - 0.5 * source.count[0]) * source.size * first +
               (j + 0.5 - 0.5 * source.count[1]) * source.size * second;
      seed.half_size.setConstant(0.5 * source.size);
      if (plane) seed.half_size[2] = 0.5 * model.grid.thickness;
      if (plane && std::min(std::abs(n[0]), std::abs(n[1])) > 1e-12) {
        Mat3 axes = seed.half_size.asDiagonal();
        axes.col(0) = seed.half_size[0] * n, axes.col(1) = seed.half_size[1] * first;
        seed.half_axes = axes;
      }
      seed.volume = 8 * seed.half_size.prod();
      const MaterialSpec& spec = model.materials[static_cast<std::size_t>(source.material)];
      seed.mass = seed.volume * spec.law->density();
      seed.temperature = model.heat.reference;
      out.push_back(std::move(seed));
    }
  return out;
}

}  // namespace

std::vector<LaterSeed> later_seeds(const Model& model) {
  std::vector<LaterSeed> out;
  for (const Placement& placement : model.placements) {
    Model alone = model;
    alone.pieces = placement.pieces, alone.points.clear();
    for (const Seed& seed : place_points(alone)) out.push_back({seed, placement.stage});
  }
  for (std::size_t k = 0; k < model.sources.size(); ++k)
    for (Seed& seed : row_of(model, model.sources[k])) out.push_back({std::move(seed), -1 - static_cast<int>(k)});
  return out;
}

template <int Dim>
void set_aside(const Model& model, Body<Dim>& body, std::size_t present, const std::vector<int>& stages,
               System<Dim>& system) {
  std::vector<std::uint32_t> stays(present);
  std::iota(stays.begin(), stays.end(), 0U);
  const bool rigid = body.law->rigid();
  const auto keep = [&](int stage, std::vector<PlacedParticles<Dim>>& in) {
    std::vector<std::uint32_t> comes;
    for (std::size_t k = 0; k < stages.size(); ++k)
      if (stages[k] == stage) comes.push_back(static_cast<std::uint32_t>(present + k));
    if (comes.empty()) return;
    Particles<Dim> placed = body.particles;
    placed.reorder(comes);
    in.push_back({rigid, (rigid ? system.rigids : system.bodies).size(), std::move(placed)});
  };
  if (model.stage.number > 0) keep(model.stage.number, system.placed);
  for (std::size_t k = 0; k < model.sources.size(); ++k) {
    std::vector<PlacedParticles<Dim>> row;
    keep(-1 - static_cast<int>(k), row);
    if (row.empty()) continue;
    system.inflow.push_back({k, std::move(row.front()), model.sources[k].size});
  }
  body.particles.reorder(stays);
  body.weigh();
  body.refresh();
}

template void set_aside(const Model&, Body<2>&, std::size_t, const std::vector<int>&, System<2>&);
template void set_aside(const Model&, Body<3>&, std::size_t, const std::vector<int>&, System<3>&);

}  // namespace tribo
