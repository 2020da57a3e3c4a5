// SPDX-License-Identifier: MIT
#include "solver/heat/temperature_ramps.hpp"

#include "base/parallel.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
double TemperatureRamps<Dim>::apply(double dt) {
  double heat = 0.0;
  for (const TemperatureRamp& ramp : ramps_) {
    const double change = ramp.change * (ramp.done(system_.time + dt) - ramp.done(system_.time));
    if (change == 0.0) continue;
    for (auto& body : system_.bodies)
      if (body.temperature) heat += heat_up(body, ramp, change, dt);
  }
  return heat;
}

// The sum is over pieces of constant size, in their order.
template <int Dim>
double TemperatureRamps<Dim>::heat_up(Body<Dim>& body, const TemperatureRamp& ramp, double change, double dt) {
  static constexpr std::size_t piece = 4096;
  const std::size_t count = body.particles.size();
  std::vector<double> heats((count + piece - 1) / piece);
  double* temperature = body.particles[body.temperature];
  const double* mass = body.particles.mass();
  const auto x = body.particles.x();
  const double middle = (system_.time + 0.5 * dt) / ramp.function_time;
  parallel_for(static_cast<std::ptrdiff_t>(heats.size()), [&](std::ptrdiff_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * piece, end = std::min(first + piece, count);
    double heat = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      double share = 1.0;
      if (ramp.share) {
        Vec3 at = Vec3::Zero();
        for (std::size_t d = 0; d < Dim; ++d) at[static_cast<Eigen::Index>(d)] = x[d][i];
        share = (*ramp.share)(Variables::at(at, middle));
      }
      temperature[i] += share * change;
      heat += mass[i] * body.heat_capacity * share * change;
    }
    heats[static_cast<std::size_t>(k)] = heat;
  });
  double all = 0.0;
  for (const double heat : heats) all += heat;
  return all;
}

template class TemperatureRamps<2>;
template class TemperatureRamps<3>;

}  // namespace tribo
