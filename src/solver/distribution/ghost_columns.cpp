// SPDX-License-Identifier: MIT
#include "solver/distribution/ghost_columns.hpp"

#include <algorithm>
#include <string_view>

namespace tribo {

template <int Dim>
std::vector<std::size_t> changing_columns(const Body<Dim>& body) {
  const auto stays = [](std::string_view name) {
    return name == "mass" || name == "load_set" || name.starts_with("origin") || name.starts_with("half_");
  };
  std::vector<std::size_t> out;
  const auto& columns = body.particles.columns();
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (!stays(columns[c].name)) out.push_back(c);
  return out;
}

template <int Dim>
bool reads_whole_ghosts(const Model& model, const System<Dim>& system) {
  const auto acts_on_faces = [](const ParticleCondition& c) { return c.kind != ParticleCondition::Kind::force; };
  return system.fields.size() > 1 || !system.rigids.empty() || !system.cracks.empty() || !system.joints.empty() ||
         std::ranges::any_of(model.particle_conditions, acts_on_faces);
}

template std::vector<std::size_t> changing_columns(const Body<2>&);
template std::vector<std::size_t> changing_columns(const Body<3>&);
template bool reads_whole_ghosts(const Model&, const System<2>&);
template bool reads_whole_ghosts(const Model&, const System<3>&);

}  // namespace tribo
