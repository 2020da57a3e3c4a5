// SPDX-License-Identifier: MIT
#include "solver/transfer/scattered_columns.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
std::vector<std::size_t> scattered_columns(Body<Dim>& body, Scatter what, bool from_start) {
  Particles<Dim>& particles = body.particles;
  std::vector<std::size_t> out;
  const auto add = [&](const double* column) {
    const auto& columns = particles.columns();
    const auto found = std::ranges::find_if(columns, [&](const auto& c) { return c.data.data() == column; });
    if (column && found != columns.end()) out.push_back(static_cast<std::size_t>(found - columns.begin()));
  };
  const auto add_all = [&](const auto& pointers) {
    for (const double* column : pointers) add(column);
  };
  const bool momentum = what == Scatter::momentum || what == Scatter::momentum_and_force;
  if (momentum) {
    add_all(particles.v());
    if (body.affine) add_all(particles[body.affine]);
    if (!from_start) add_all(particles.x());
    if (!from_start && body.domain) add_all(particles[body.domain]);
  }
  if (what == Scatter::force || what == Scatter::momentum_and_force) {
    add_all(particles.stress()), add(particles.volume());
    if (body.volumetric) add(particles[body.volumetric]);
    if (body.load) add_all(particles[body.load]);
  }
  switch (what) {
    case Scatter::filtered:
      add_all(particles[body.filtered]);
      break;
    case Scatter::heat:
      add(particles[body.temperature]), add(particles.volume());
      add_all(particles[body.temperature_gradient]);
      break;
    case Scatter::heat_residual:
      add(particles[body.temperature_residual]);
      break;
    case Scatter::volumetric:
    case Scatter::volume:
      add(particles.volume()), add_all(particles.x());
      if (what == Scatter::volumetric) add(particles[body.volumetric]);
      break;
    default:
      break;
  }
  return out;
}

template std::vector<std::size_t> scattered_columns(Body<2>&, Scatter, bool);
template std::vector<std::size_t> scattered_columns(Body<3>&, Scatter, bool);

}  // namespace tribo
