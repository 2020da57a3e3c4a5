// SPDX-License-Identifier: MIT
#include "run/tracers.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
double Tracers<Dim>::search(const HistoryQuantity& q, std::vector<Body<Dim>>& bodies, double cell, Tracer& tracer) {
  double nearest = 1e300;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    auto& body = bodies[b];
    if ((q.material >= 0 && body.material != q.material) || body.block >= 0) continue;
    const auto start = body.particles[body.origin];
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      double distance = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double along = (start[d][i] - (*q.point)[static_cast<Eigen::Index>(d)]) / cell;
        distance += along * along;
      }
      const std::int64_t id = body.particles.id[i];
      // Rounding must not decide between particles at the same distance
      const bool nearer = distance < nearest - 1e-9, as_near = distance < nearest + 1e-9;
      if (nearer || (as_near && id < tracer.id)) tracer = {false, b, id}, nearest = std::min(distance, nearest);
    }
  }
  return nearest;
}

template <int Dim>
Tracers<Dim>::Tracers(const Model& model, System<Dim>& system) {
  const double cell = system.lattice.spacing.maxCoeff();
  for (const auto& q : model.output.history) {
    Tracer tracer;
    if (q.point && search(q, system.bodies, cell, tracer) > 1.0) {
      if (search(q, system.rigids, cell, tracer) > 1.0)
        throw InputError(q.origin, "'" + q.column + "': no particle starts within a cell of this point");
      tracer.rigid = true;
    }
    tracers_.push_back(tracer);
  }
}

template <int Dim>
Measures Tracers<Dim>::measure(System<Dim>& system, std::size_t k, bool strain) const {
  auto& body = (tracers_[k].rigid ? system.rigids : system.bodies)[tracers_[k].body];
  const std::size_t at = particle(system, k);
  return at < body.particles.size() ? measure_particle(body, at, strain) : Measures{};
}

template <int Dim>
std::size_t Tracers<Dim>::particle(const System<Dim>& system, std::size_t k) const {
  const auto& id = (tracers_[k].rigid ? system.rigids : system.bodies)[tracers_[k].body].particles.id;
  return static_cast<std::size_t>(std::find(id.begin(), id.end(), tracers_[k].id) - id.begin());
}

template class Tracers<2>;
template class Tracers<3>;

}  // namespace tribo
