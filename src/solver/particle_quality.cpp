// SPDX-License-Identifier: MIT
#include "solver/particle_quality.hpp"

#include "base/parallel.hpp"
#include "materials/material.hpp"
#include "solver/particle_splitting.hpp"
#include "solver/state/particle_domain.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

/// Length from which on a domain leaves holes [cells]: particles reach over one cell, and a quarter more is tolerated;
/// and how many times its initial length it must be.
constexpr double longest_domain = 1.25, least_stretch = 1.5;

// Adds a particle; `worse`: whether its value is worse than the worst so far.
void take(BadParticles& bad, double value, bool worse, const Vec3& place) {
  if (bad.count++ == 0 || worse) bad.worst = value, bad.place = place;
}

// The first of two equally bad particles counts, so that the order of the sums decides nothing else.
void add(BadParticles& to, const BadParticles& from, bool worse) {
  if (from.count > 0 && (to.count == 0 || worse)) to.worst = from.worst, to.place = from.place;
  to.count += from.count;
}

// Length of the longest of the shortest vectors that span the domain, in cells; 0 if it is no hole. `ratio`: V/V0;
// without F (`deforms` false) the axes are the initial ones.
template <int Dim>
double hole(const Mat<Dim>& axes, const Vec<Dim>& per_cell, double ratio, bool deforms) {
  const Mat<Dim> scaled = (2 * per_cell).asDiagonal() * axes;
  const double square = scaled.colwise().squaredNorm().maxCoeff();
  // Most particles end here: the vectors of the reduced basis are not longer, nor is a cube of this volume.
  if (deforms ? square <= longest_domain * longest_domain : std::sqrt(square) * std::max(1.0, ratio) <= longest_domain)
    return 0.0;
  const double volume = std::abs(scaled.determinant());
  const double start = std::pow(deforms ? volume / ratio : volume, 1.0 / Dim);
  const double length = deforms ? std::sqrt(reduced<Dim>({scaled, Mat<Dim>::Identity()}, Vec<Dim>::Ones())
                                                .current.colwise()
                                                .squaredNorm()
                                                .maxCoeff())
                                : std::sqrt(square) * std::pow(ratio, 1.0 / Dim);
  return length > std::max(longest_domain, least_stretch * start) ? length : 0.0;
}

template <int Dim>
ParticleQuality look_at(Body<Dim>& body, const Vec<Dim>& per_cell, const VolumeRange& ordinary, std::size_t first,
                        std::size_t last) {
  ParticleQuality out;
  auto& particles = body.particles;
  const double density = body.law->density();
  const bool deforms = particles.has_deformation();
  const bool holds_together = std::isfinite(ordinary.high);
  const DomainReader<Dim> domain(body);
  for (std::size_t i = first; i < last; ++i) {
    const double ratio = particles.volume()[i] * density / particles.mass()[i];
    const double length =
        holds_together ? hole<Dim>(domain(static_cast<std::uint32_t>(i)).axes, per_cell, ratio, deforms) : 0.0;
    if (ratio >= ordinary.low && ratio <= ordinary.high && length == 0.0) continue;
    Vec3 place = Vec3::Zero();
    place.head<Dim>() = particles.position(i);
    if (ratio < ordinary.low) take(out.compressed, ratio, ratio < out.compressed.worst, place);
    if (ratio > ordinary.high) take(out.expanded, ratio, ratio > out.expanded.worst, place);
    if (length > 0) take(out.stretched, length, length > out.stretched.worst, place);
  }
  return out;
}

}  // namespace

template <int Dim>
ParticleQuality particle_quality(Body<Dim>& body, const Lattice<Dim>& lattice, const VolumeRange& ordinary) {
  static constexpr std::size_t piece = 4096;
  const std::size_t n = body.particles.size();
  std::vector<ParticleQuality> parts((n + piece - 1) / piece);
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * piece;
    parts[static_cast<std::size_t>(k)] =
        look_at<Dim>(body, lattice.spacing.cwiseInverse(), ordinary, first, std::min(n, first + piece));
  });
  ParticleQuality all;
  for (const auto& part : parts) {
    add(all.compressed, part.compressed, part.compressed.worst < all.compressed.worst);
    add(all.expanded, part.expanded, part.expanded.worst > all.expanded.worst);
    add(all.stretched, part.stretched, part.stretched.worst > all.stretched.worst);
  }
  return all;
}

template <int Dim>
VolumeRange volume_range(Body<Dim>& body) {
  auto& particles = body.particles;
  VolumeRange out{1.0, 1.0};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double ratio = particles.volume()[i] * body.law->density() / particles.mass()[i];
    out.low = i == 0 ? ratio : std::min(out.low, ratio), out.high = i == 0 ? ratio : std::max(out.high, ratio);
  }
  return out;
}

template VolumeRange volume_range<2>(Body<2>&);
template VolumeRange volume_range<3>(Body<3>&);
template ParticleQuality particle_quality<2>(Body<2>&, const Lattice<2>&, const VolumeRange&);
template ParticleQuality particle_quality<3>(Body<3>&, const Lattice<3>&, const VolumeRange&);

}  // namespace tribo
