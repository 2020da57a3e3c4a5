// SPDX-License-Identifier: MIT
#include "solver/particle_sort.hpp"

#include "materials/material.hpp"
#include "solver/boundary/periodic.hpp"
#include "solver/diagnose.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
void ParticleSort<Dim>::sort() {
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (auto& body : *bodies) {
      return_through_period(model_.grid, system_.lattice, body);
      const auto some_are_outside = [&] { return any_rank(body.bins.sort(system_.lattice, body.particles) >= 0); };
      if (some_are_outside()) {
        return_to_grid(body);
        if (some_are_outside()) stop_at_bad_particle(system_);
      }
    }
  distribution_.exchange();
  system_.drift = 0.0;
  system_.sorted = true;
}

// Moves particles that left the grid to its edge and sets the velocity component in this direction to zero. Those of a
// rigid body would no longer have its shape.
template <int Dim>
void ParticleSort<Dim>::return_to_grid(Body<Dim>& body) {
  const bool rigid = model_.materials[static_cast<std::size_t>(body.material)].law->rigid();
  if (!model_.leave_limit || (rigid && !model_.delete_leaving)) stop_at_bad_particle(system_);
  const auto x = body.particles.x(), v = body.particles.v();
  // Calls f(axis, particle, place at the edge) for what is outside.
  const auto each_outside = [&](auto&& f) {
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (std::size_t d = 0; d < Dim; ++d) {
        const auto axis = static_cast<Eigen::Index>(d);
        const double inside = std::clamp(x[d][i], system_.lattice.low[axis], system_.lattice.high[axis]);
        if (x[d][i] != inside && std::isfinite(x[d][i])) f(d, i, inside);
      }
  };
  OrderlessSums<1> outside;
  each_outside([&](std::size_t, std::size_t, double) { outside.add(1.0); });
  returned += std::lround(outside.total()[0]);
  if (returned > *model_.leave_limit) stop_at_bad_particle(system_);
  each_outside([&](std::size_t d, std::size_t i, double inside) { x[d][i] = inside, v[d][i] = 0.0; });
}

template class ParticleSort<2>;
template class ParticleSort<3>;

}  // namespace tribo
