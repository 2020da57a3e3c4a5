// SPDX-License-Identifier: MIT
#include "solver/measures.hpp"

#include "base/parallel.hpp"
#include "base/ranks.hpp"
#include "base/strain.hpp"
#include "solver/transfer/material_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

// Calls f(number, value) for all values that are sums over particles.
template <class M, class F>
void each_sum(M& m, F&& f) {
  std::size_t k = 0;
  for (auto* value : {&m.mass, &m.volume, &m.kinetic, &m.stored, &m.dissipated, &m.expansion, &m.work_heat, &m.heat,
                      &m.temperature, &m.weighted_temperature})
    f(k++, *value);
  for (auto* vector : {&m.momentum, &m.angular_momentum, &m.centre, &m.displacement})
    for (auto& value : vector->reshaped()) f(k++, value);
  for (auto* tensor : {&m.stress, &m.deformation, &m.strain})
    for (auto& value : tensor->reshaped()) f(k++, value);
}
constexpr std::size_t sum_count = 10 + 4 * 3 + 3 * 9;

void include_extremes(Measures& to, const Measures& from) {
  to.low = to.low.cwiseMin(from.low), to.high = to.high.cwiseMax(from.high);
  to.largest_speed = std::max(to.largest_speed, from.largest_speed);
  to.largest_wave_speed = std::max(to.largest_wave_speed, from.largest_wave_speed);
  to.least_volume_ratio = std::min(to.least_volume_ratio, from.least_volume_ratio);
}

// Adds the measures of ranges of particles, whose order and distribution over processes do not matter.
class MeasureSums {
 public:
  MeasureSums() { sums_.start(sum_count + 1), extremes_.least_volume_ratio = 1e300; }

  void add(const Measures& range) {
    each_sum(range, [&](std::size_t k, double value) { sums_.add(k, value); });
    sums_.add(sum_count, static_cast<double>(range.particles));
    include_extremes(extremes_, range);
  }
  void add(const MeasureSums& other) {
    sums_.add(other.sums_);
    include_extremes(extremes_, other.extremes_);
  }
  // Of all ranks; to be called once.
  Measures total() {
    sums_.finish();
    Measures out = extremes_;
    each_sum(out, [&](std::size_t k, double& value) { value = sums_[k]; });
    out.particles = std::llround(sums_[sum_count]);
    if (ranks().count() > 1) find_extremes_of_ranks(out);
    return out;
  }

 private:
  static void find_extremes_of_ranks(Measures& m) {
    std::array<double, 9> largest{};
    for (int d = 0; d < 3; ++d) {
      largest[static_cast<std::size_t>(d)] = -m.low[d];
      largest[static_cast<std::size_t>(3 + d)] = m.high[d];
    }
    largest[6] = m.largest_speed, largest[7] = m.largest_wave_speed, largest[8] = -m.least_volume_ratio;
    ranks().largest(largest);
    for (int d = 0; d < 3; ++d) {
      m.low[d] = -largest[static_cast<std::size_t>(d)];
      m.high[d] = largest[static_cast<std::size_t>(3 + d)];
    }
    m.largest_speed = largest[6], m.largest_wave_speed = largest[7], m.least_volume_ratio = -largest[8];
  }

  SumList sums_;
  Measures extremes_;
};

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
void sum(Body<Dim>& body, bool strain, MeasureSums& all) {
  std::vector<Bin> pieces;
  const auto ranges = body.bins.sum_ranges(body.particles.size(), pieces);
  std::vector<Measures> parts(ranges.size());
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const Bin& range = ranges[static_cast<std::size_t>(k)];
    parts[static_cast<std::size_t>(k)] =
        measure_range(body, range.begin, static_cast<int>(range.end - range.begin), strain);
  });
  for (const Measures& part : parts) all.add(part);
}

template <int Dim>
Measures sum(Body<Dim>& body, bool strain) {
  MeasureSums all;
  sum(body, strain, all);
  return all.total();
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
  MeasureSums sums;
  bodies.clear();
  for (auto& body : system.bodies) {
    MeasureSums of_body;
    sum(body, strain, of_body);
    sums.add(of_body);
    bodies.push_back(of_body.total());
    average(bodies.back());
  }
  Measures all = sums.total();
  average(all);
  return all;
}

template <int Dim>
Measures measure(System<Dim>& system, bool strain, std::optional<int> material) {
  MeasureSums sums;
  for (auto& body : system.bodies)
    if (!material || body.material == *material) sum(body, strain, sums);
  Measures all = sums.total();
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
