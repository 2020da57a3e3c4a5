// SPDX-License-Identifier: MIT
#include "solver/measures.hpp"

#include "base/parallel.hpp"
#include "base/strain.hpp"
#include "solver/transfer/material_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Sums, minima and maxima of f(particle) over a range, computed for several particles at a time.
template <class F>
double sum_of(std::size_t begin, std::size_t end, F&& f) {
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = begin; i < end; ++i) sum += f(i);
  return sum;
}
template <class F>
double least_of(std::size_t begin, std::size_t end, F&& f) {
  double least = std::numeric_limits<double>::max();
#pragma omp simd reduction(min : least)
  for (std::size_t i = begin; i < end; ++i) {
    const double value = f(i);
    least = value < least ? value : least;
  }
  return least;
}
template <class F>
double largest_of(std::size_t begin, std::size_t end, F&& f) {
  return -least_of(begin, end, [&](std::size_t i) { return -f(i); });
}

// Adds the contents of the particles from `begin` to before `end`, which are so few that they stay in the cache.
template <int Dim>
class PieceSums {
 public:
  PieceSums(Body<Dim>& body, std::size_t begin, std::size_t end) : body_(body), begin_(begin), end_(end) {}

  void add_motion(Measures& m) const {
    const auto x = body_.particles.x(), v = body_.particles.v(), origin = body_.particles[body_.origin];
    const double* mass = body_.particles.mass();
    m.mass += sum([=](std::size_t i) { return mass[i]; });
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      const double *at = x[d], *speed = v[d], *start = origin[d];
      m.momentum[k] += sum([=](std::size_t i) { return mass[i] * speed[i]; });
      m.centre[k] += sum([=](std::size_t i) { return mass[i] * at[i]; });
      m.displacement[k] += sum([=](std::size_t i) { return mass[i] * (at[i] - start[i]); });
      m.kinetic += 0.5 * sum([=](std::size_t i) { return mass[i] * speed[i] * speed[i]; });
      m.low[k] = std::min(m.low[k], least_of(begin_, end_, [=](std::size_t i) { return at[i]; }));
      m.high[k] = std::max(m.high[k], largest_of(begin_, end_, [=](std::size_t i) { return at[i]; }));
      m.largest_speed =
          std::max(m.largest_speed, largest_of(begin_, end_, [=](std::size_t i) { return std::abs(speed[i]); }));
    }
    if constexpr (Dim == 2) m.low[2] = std::min(m.low[2], 0.0), m.high[2] = std::max(m.high[2], 0.0);
    add_angular_momentum(m);
  }

  void add_stress(Measures& m) const {
    const double *mass = body_.particles.mass(), *volume = body_.particles.volume();
    const double density = body_.law->density();
    m.volume += sum([=](std::size_t i) { return volume[i]; });
    m.least_volume_ratio = std::min(
        m.least_volume_ratio, least_of(begin_, end_, [=](std::size_t i) { return volume[i] * density / mass[i]; }));
    const auto stress = body_.particles.stress();
    Mat3& total = m.stress;
    for (std::size_t k = 0; k < static_cast<std::size_t>(Layout<Dim>::symmetric); ++k) {
      const auto [r, s] = Layout<Dim>::symmetric_at[k];
      const double part = weighted(volume, stress[k]);
      total(r, s) += part;
      if (r != s) total(s, r) += part;
    }
  }

  void add_deformation(Measures& m, bool strain) const {
    const auto F = body_.particles.F();
    const double* volume = body_.particles.volume();
    for (std::size_t k = 0; F[0] && k < static_cast<std::size_t>(Layout<Dim>::full); ++k) {
      const auto [r, s] = Layout<Dim>::full_at[k];
      m.deformation(r, s) += weighted(volume, F[k]);
    }
    for (std::size_t i = begin_; F[0] && strain && i < end_; ++i)
      m.strain += volume[i] * biot_strain(load_full<Dim>(F, static_cast<int>(i)));
  }

  void add_heat(Measures& m) const {
    const double *mass = body_.particles.mass(), density = body_.law->density();
    if (body_.temperature) {
      const double capacity = body_.heat_capacity, weight = capacity > 0 ? capacity : 1.0;
      const double of_mass = sum([=](std::size_t i) { return mass[i]; });
      const double of_temperature = weighted(mass, body_.particles[body_.temperature]);
      m.heat += capacity * of_temperature;
      m.weighted_temperature += weight * of_temperature, m.temperature += weight * of_mass;
    }
    if (body_.expansion_work) m.expansion += weighted(mass, body_.particles[body_.expansion_work]) / density;
    if (body_.heated) m.work_heat += body_.taylor_quinney * weighted(mass, body_.particles[body_.heated]) / density;
    if (const int k = body_.law->dissipation_index(); k >= 0)
      m.dissipated += weighted(mass, body_.history_columns[static_cast<std::size_t>(k)]) / density;
  }

 private:
  template <class F>
  double sum(F&& f) const {
    return sum_of(begin_, end_, f);
  }
  double weighted(const double* weight, const double* value) const {
    return sum([=](std::size_t i) { return weight[i] * value[i]; });
  }

  void add_angular_momentum(Measures& m) const {
    const auto x = body_.particles.x(), v = body_.particles.v();
    const double* mass = body_.particles.mass();
    for (std::size_t axis = Dim == 2 ? 2 : 0; axis < 3; ++axis) {
      const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
      const double *xa = x[a], *xb = x[b], *va = v[a], *vb = v[b];
      m.angular_momentum[static_cast<Eigen::Index>(axis)] +=
          sum([=](std::size_t i) { return mass[i] * (xa[i] * vb[i] - xb[i] * va[i]); });
    }
    for (std::size_t i = begin_; body_.affine && i < end_; ++i) m.angular_momentum += mass[i] * affine_spin(body_, i);
  }

  Body<Dim>& body_;
  std::size_t begin_, end_;
};

template <int Dim>
Measures measure_range(Body<Dim>& body, std::uint32_t first, int count, bool strain) {
  constexpr std::size_t piece = 512;
  Measures m;
  m.particles = count;
  m.least_volume_ratio = 1e300;
  const std::size_t end = first + static_cast<std::size_t>(count);
  for (std::size_t begin = first; begin < end; begin += piece) {
    const PieceSums<Dim> sums(body, begin, std::min(end, begin + piece));
    sums.add_motion(m), sums.add_stress(m), sums.add_deformation(m, strain), sums.add_heat(m);
  }
  HistoryPointers history{};
  const auto points = points_of(body, first, count, history);
  m.stored = body.law->stored_energy(points);
  m.largest_wave_speed = std::sqrt(body.law->wave_modulus(points) / body.law->density());
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
Measures measure_all(System<Dim>& system, bool strain, std::vector<Measures>& bodies) {
  Measures all;
  all.least_volume_ratio = 1e300;
  bodies.clear();
  for (auto& body : system.bodies) {
    bodies.push_back(sum(body, strain));
    add(all, bodies.back());
    average(bodies.back());
  }
  average(all);
  return all;
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
template Measures measure_all<2>(System<2>&, bool, std::vector<Measures>&);
template Measures measure_all<3>(System<3>&, bool, std::vector<Measures>&);
template Measures measure<2>(System<2>&, bool, std::optional<int>);
template Measures measure<3>(System<3>&, bool, std::optional<int>);

}  // namespace tribo
