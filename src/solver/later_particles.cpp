// SPDX-License-Identifier: MIT
#include "solver/later_particles.hpp"

#include <numeric>

namespace tribo {

std::vector<LaterSeed> later_seeds(const Model& model) {
  std::vector<LaterSeed> out;
  for (const Placement& placement : model.placements) {
    Model alone = model;
    alone.pieces = placement.pieces, alone.points.clear();
    for (Seed& seed : place_points(alone)) out.push_back({std::move(seed), placement.stage});
  }
  return out;
}

template <int Dim>
void set_aside(const Model& model, Body<Dim>& body, std::size_t present, const std::vector<int>& stages,
               System<Dim>& system) {
  std::vector<std::uint32_t> stays(present), comes;
  std::iota(stays.begin(), stays.end(), 0U);
  for (std::size_t k = 0; k < stages.size(); ++k)
    if (stages[k] == model.stage.number) comes.push_back(static_cast<std::uint32_t>(present + k));
  if (!comes.empty()) {
    const bool rigid = body.law->rigid();
    Particles<Dim> placed = body.particles;
    placed.reorder(comes);
    system.placed.push_back({rigid, (rigid ? system.rigids : system.bodies).size(), std::move(placed)});
  }
  body.particles.reorder(stays);
  body.total_mass = 0.0;
  for (std::size_t i = 0; i < present; ++i) body.total_mass += body.particles.mass()[i];
  body.refresh();
}

template void set_aside(const Model&, Body<2>&, std::size_t, const std::vector<int>&, System<2>&);
template void set_aside(const Model&, Body<3>&, std::size_t, const std::vector<int>&, System<3>&);

}  // namespace tribo
