// SPDX-License-Identifier: MIT
#include "solver/measures.hpp"

#include "base/parallel.hpp"
#include "base/strain.hpp"
#include "solver/transfer/material_points.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

void add(Measures& to, const Measures& from) {
  to.mass += from.mass, to.volume += from.volume, to.particles += from.particles;
  to.momentum += from.momentum, to.angular_momentum += from.angular_momentum;
  to.centre += from.centre, to.displacement += from.displacement;
  to.kinetic += from.kinetic, to.stored += from.stored, to.dissipated += from.dissipated;
  to.heat += from.heat, to.expansion += from.expansion, to.work_heat += from.work_heat,
      to.temperature += from.temperature;
  to.weighted_temperature += from.weighted_temperature;
  to.stress += from.stress, to.deformation += from.deformation, to.strain += from.strain;
  to.low = to.low.cwiseMin(from.low), to.high = to.high.cwiseMax(from.high);
  to.largest_speed = std::max(to.largest_speed, from.largest_speed);
  to.largest_wave_speed = std::max(to.largest_wave_speed, from.largest_wave_speed);
  to.least_volume_ratio = std::min(to.least_volume_ratio, from.least_volume_ratio);
}

// Converts sums into means.
void average(Measures& m) {
  if (m.mass > 0) m.centre /= m.mass, m.displacement /= m.mass;
  // m.temperature is the sum of the weights before this line
  if (m.temperature > 0) m.temperature = m.weighted_temperature / m.temperature;
  if (m.volume > 0) m.stress /= m.volume, m.deformation /= m.volume, m.strain /= m.volume;
}

// Angular momentum per mass of the affine velocity field of a particle: eps : C D (Jiang et al., JCP 338 (2017)
// 137-164).
template <int Dim>
Vec3 affine_spin(Body<Dim>& body, std::size_t i) {
  const auto B = [&](std::size_t r, std::size_t c) { return body.particles[body.affine][r * Dim + c][i]; };
  Vec3 spin = Vec3::Zero();
  spin[2] = B(1, 0) - B(0, 1);
  if constexpr (Dim == 3) spin[0] = B(2, 1) - B(1, 2), spin[1] = B(0, 2) - B(2, 0);
  return spin;
}

template <int Dim>
Measures measure_range(Body<Dim>& body, std::uint32_t first, int count, bool strain) {
  Measures m;
  auto& particles = body.particles;
  const auto x = particles.x(), v = particles.v(), origin = particles[body.origin];
  const auto stress = particles.stress();
  const auto F = particles.F();
  const double density = body.law->density();
  m.particles = count;
  m.least_volume_ratio = 1e300;
  for (auto i = static_cast<std::size_t>(first); i < first + static_cast<std::size_t>(count); ++i) {
    Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), shift = Vec3::Zero();
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      position[k] = x[d][i], velocity[k] = v[d][i], shift[k] = x[d][i] - origin[d][i];
    }
    const double mass = particles.mass()[i], volume = particles.volume()[i];
    m.mass += mass, m.volume += volume;
    m.momentum += mass * velocity;
    m.angular_momentum += mass * position.cross(velocity);
    if (body.affine) m.angular_momentum += mass * affine_spin(body, i);
    m.low = m.low.cwiseMin(position), m.high = m.high.cwiseMax(position);
    m.centre += mass * position, m.displacement += mass * shift;
    if (body.temperature) {
      const double capacity = mass * body.heat_capacity;
      const double weight = body.heat_capacity > 0 ? capacity : mass;
      m.heat += capacity * particles[body.temperature][i];
      m.weighted_temperature += weight * particles[body.temperature][i], m.temperature += weight;
    }
    if (body.expansion_work) m.expansion += particles[body.expansion_work][i] * mass / density;
    if (body.heated) m.work_heat += body.taylor_quinney * particles[body.heated][i] * mass / density;
    m.kinetic += 0.5 * mass * velocity.squaredNorm();
    m.stress += volume * load_symmetric<Dim>(stress, static_cast<int>(i));
    if (F[0]) m.deformation += volume * load_full<Dim>(F, static_cast<int>(i));
    if (F[0] && strain) m.strain += volume * biot_strain(load_full<Dim>(F, static_cast<int>(i)));
    m.largest_speed = std::max(m.largest_speed, velocity.cwiseAbs().maxCoeff());
    m.least_volume_ratio = std::min(m.least_volume_ratio, volume * density / mass);
    m.dissipated += dissipated_energy(body, i);
  }
  HistoryPointers history{};
  const auto points = points_of(body, first, count, history);
  m.stored = body.law->stored_energy(points);
  m.largest_wave_speed = std::sqrt(body.law->wave_modulus(points) / density);
  return m;
}

template <int Dim>
Measures sum(Body<Dim>& body, bool strain) {
  static constexpr std::size_t piece = 4096;
  const std::size_t n = body.particles.size();
  std::vector<Measures> parts((n + piece - 1) / piece);
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * piece;
    parts[static_cast<std::size_t>(k)] =
        measure_range(body, static_cast<std::uint32_t>(first), static_cast<int>(std::min(piece, n - first)), strain);
  });
  Measures all;
  all.least_volume_ratio = 1e300;
  for (const auto& part : parts) add(all, part);
  return all;
}

}  // namespace

template <int Dim>
Measures measure(Body<Dim>& body, bool strain) {
  Measures m = sum(body, strain);
  average(m);
  return m;
}

template <int Dim>
Measures measure_particle(Body<Dim>& body, std::size_t particle, bool strain) {
  Measures m = measure_range(body, static_cast<std::uint32_t>(particle), 1, strain);
  average(m);
  return m;
}

template <int Dim>
Measures measure(System<Dim>& system, bool strain, std::optional<int> material) {
  Measures all;
  all.least_volume_ratio = 1e300;
  for (auto& body : system.bodies)
    if (!material || body.material == *material) add(all, sum(body, strain));
  average(all);
  return all;
}

template Measures measure<2>(Body<2>&, bool);
template Measures measure<3>(Body<3>&, bool);
template Measures measure_particle<2>(Body<2>&, std::size_t, bool);
template Measures measure_particle<3>(Body<3>&, std::size_t, bool);
template Measures measure<2>(System<2>&, bool, std::optional<int>);
template Measures measure<3>(System<3>&, bool, std::optional<int>);

}  // namespace tribo
