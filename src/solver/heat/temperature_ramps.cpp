// SPDX-License-Identifier: MIT
#include "solver/heat/temperature_ramps.hpp"

#include "base/parallel.hpp"

namespace tribo {

template <int Dim>
double TemperatureRamps<Dim>::apply(double dt) {
  if (ramps_.empty()) return 0.0;
  OrderlessSums<1> heat;
  for (const TemperatureRamp& ramp : ramps_) {
    const double change = ramp.change * (ramp.done(system_.time + dt) - ramp.done(system_.time));
    if (change == 0.0) continue;
    for (auto& body : system_.bodies)
      if (body.temperature) heat_up(body, ramp, change, dt, heat);
  }
  return heat.total()[0];
}

template <int Dim>
void TemperatureRamps<Dim>::heat_up(Body<Dim>& body, const TemperatureRamp& ramp, double change, double dt,
                                    OrderlessSums<1>& all) {
  std::vector<Bin> pieces;
  const auto ranges = body.bins.sum_ranges(body.particles.size(), pieces);
  std::vector<double> heats(ranges.size());
  double* temperature = body.particles[body.temperature];
  const double* mass = body.particles.mass();
  const auto x = body.particles.x();
  const double middle = (system_.time + 0.5 * dt) / ramp.function_time;
  parallel_for(static_cast<std::ptrdiff_t>(heats.size()), [&](std::ptrdiff_t k) {
    const Bin& range = ranges[static_cast<std::size_t>(k)];
    double heat = 0.0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
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
  for (const double heat : heats) all.add(heat);
}

template class TemperatureRamps<2>;
template class TemperatureRamps<3>;

}  // namespace tribo
