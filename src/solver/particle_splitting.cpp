// SPDX-License-Identifier: MIT
#include "solver/particle_splitting.hpp"

#include "base/parallel.hpp"
#include "solver/measures.hpp"
#include "solver/state/particle_domain.hpp"

#include <algorithm>
#include <cmath>
#include <compare>

namespace tribo {

// A particle and the cell that contains it.
struct CellParticle {
  std::int64_t cell, id;
  std::uint32_t particle;
  auto operator<=>(const CellParticle&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer
};

namespace {

template <int Dim>
Mat<Dim> initial_axes(const Body<Dim>& body, std::size_t i) {
  Mat<Dim> axes;
  for (int k = 0; k < Dim * Dim; ++k)
    axes(k / Dim, k % Dim) = body.particles.column(body.half_axes.first() + static_cast<std::size_t>(k))[i];
  return axes;
}

template <int Dim>
void set_initial_axes(Body<Dim>& body, std::size_t i, const Mat<Dim>& axes) {
  for (int k = 0; k < Dim * Dim; ++k)
    body.particles[body.half_axes][static_cast<std::size_t>(k)][i] = axes(k / Dim, k % Dim);
}

template <int Dim>
void displace(const typename Particles<Dim>::Vector& x, std::size_t i, const Vec<Dim>& by) {
  for (std::size_t d = 0; d < Dim; ++d) x[d][i] += by[static_cast<Eigen::Index>(d)];
}

// Scales the deformation gradient in the plane or in space to the volume ratio of the particle: the mean of two
// deformation gradients has not the mean of their determinants.
template <int Dim>
void scale_deformation(Body<Dim>& body, std::uint32_t i) {
  auto& particles = body.particles;
  if (!particles.has_deformation()) return;
  const auto at = static_cast<int>(i);
  Mat3 F = load_full<Dim>(particles.F(), at);
  const double ratio = particles.volume()[i] * body.law->density() / (particles.mass()[i] * F.determinant());
  F.template topLeftCorner<Dim, Dim>() *= std::pow(ratio, 1.0 / Dim);
  store_full<Dim>(F, particles.F(), at);
}

// Edge lengths of a domain in cells.
template <int Dim>
Vec<Dim> edges(const Mat<Dim>& axes, const Vec<Dim>& cell) {
  return 2 * (cell.cwiseInverse().asDiagonal() * axes).colwise().norm().transpose();
}

}  // namespace

template <int Dim>
DomainBasis<Dim> reduced(DomainBasis<Dim> basis, const Vec<Dim>& cell) {
  const Mat<Dim> to_cells = cell.cwiseInverse().asDiagonal();
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        if (i == j) continue;
        const Vec<Dim> a = to_cells * basis.current.col(i), b = to_cells * basis.current.col(j);
        const double times = std::round(a.dot(b) / b.squaredNorm());
        if (!((a - times * b).squaredNorm() < (1 - 1e-9) * a.squaredNorm())) continue;
        basis.current.col(i) -= times * basis.current.col(j);
        basis.initial.col(i) -= times * basis.initial.col(j);
        shorter = true;
      }
  }
  return basis;
}

template <int Dim>
ParticleSplitting<Dim>::ParticleSplitting(const Model& model, System<Dim>& system, EnergyLedger& ledger)
    : spec_(model.splitting), system_(system), ledger_(ledger) {
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (const auto& body : *bodies)
      for (const std::int64_t id : body.particles.id) next_id_ = std::max(next_id_, id + 1);
}

template <int Dim>
bool ParticleSplitting<Dim>::apply() {
  if (!spec_) return false;
  const std::int64_t before = split_ + merged_;
  for (auto& body : system_.bodies) {
    split(body);
    if (spec_->merge) merge(body);
    set_half_sizes(body);
  }
  return split_ + merged_ != before;
}

// Shape functions of finite width take a box along the grid axes: the one around the domain, reduced to the volume of
// the domain, within a cell.
template <int Dim>
void ParticleSplitting<Dim>::set_half_sizes(Body<Dim>& body) {
  if (!body.half_size) return;
  const Vec<Dim>& cell = system_.lattice.spacing;
  const DomainReader<Dim> domain(body);
  const auto half_size = body.particles[body.half_size];
  parallel_for(static_cast<std::ptrdiff_t>(body.particles.size()), [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::uint32_t>(k);
    const Mat<Dim> axes = reduced<Dim>({domain(i).axes, Mat<Dim>::Identity()}, cell).current;
    Vec<Dim> half = axes.cwiseAbs().rowwise().sum();
    half *= std::pow(std::abs(axes.determinant()) / half.prod(), 1.0 / Dim);
    half = half.cwiseMin(0.5 * cell);
    for (std::size_t d = 0; d < Dim; ++d) half_size[d][i] = half[static_cast<Eigen::Index>(d)];
  });
}

// A domain that was stretched by more than twice the limit splits more than once.
template <int Dim>
void ParticleSplitting<Dim>::split(Body<Dim>& body) {
  for (int pass = 0; pass < 8 && split_once(body); ++pass) {
  }
}

// A particle is too long if it exceeds the limit, and is much longer than wide or was stretched since its last split.
template <int Dim>
auto ParticleSplitting<Dim>::long_ones(Body<Dim>& body) const -> std::vector<LongParticle> {
  const Lattice<Dim>& lattice = system_.lattice;
  const Vec<Dim>& cell = lattice.spacing;
  auto& particles = body.particles;
  const DomainReader<Dim> domain(body);
  const double* generation = particles[body.generation];
  const double* loaded = body.load_set ? particles[body.load_set] : nullptr;
  const auto inside = [&](const Vec<Dim>& at) {
    return (at.array() > lattice.low.array()).all() && (at.array() < lattice.high.array()).all();
  };
  std::vector<LongParticle> out;
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    if (generation[i] >= spec_->generations || (loaded && loaded[i] != 0.0)) continue;
    if (edges<Dim>(domain(i).axes, cell).maxCoeff() <= spec_->longest) continue;  // the reduced edges are not longer
    const auto basis = reduced<Dim>({domain(i).axes, initial_axes(body, i)}, cell);
    int axis;
    const double longest = edges<Dim>(basis.current, cell).maxCoeff(&axis);
    const double start = 2 * std::pow(std::abs(basis.initial.determinant()) / cell.prod(), 1.0 / Dim);
    const Vec<Dim> half = 0.5 * basis.current.col(axis), x = particles.position(i);
    if (longest > std::max(spec_->longest, 1.5 * start) && inside(x - half) && inside(x + half))
      out.push_back({i, basis, axis});
  }
  return out;
}

template <int Dim>
bool ParticleSplitting<Dim>::split_once(Body<Dim>& body) {
  const std::vector<LongParticle> list = long_ones(body);
  if (list.empty()) return false;
  auto& particles = body.particles;
  std::vector<std::uint32_t> originals;
  for (const LongParticle& p : list) originals.push_back(p.particle);
  auto second = static_cast<std::uint32_t>(particles.size());
  particles.append_copies(originals, next_id_);
  next_id_ += static_cast<std::int64_t>(list.size()), split_ += static_cast<std::int64_t>(list.size());
  for (const auto& [first, basis, axis] : list) {
    Mat<Dim> initial = basis.initial;
    initial.col(axis) *= 0.5;
    for (const auto& [i, sign] : {std::pair(first, -0.5), std::pair(second, 0.5)}) {
      displace<Dim>(particles.x(), i, sign * basis.current.col(axis));
      displace<Dim>(particles[body.origin], i, sign * basis.initial.col(axis));
      set_initial_axes(body, i, initial);
      particles.mass()[i] *= 0.5, particles.volume()[i] *= 0.5;
      particles[body.generation][i] += 1.0;
    }
    ++second;
  }
  body.refresh();
  return true;
}

template <int Dim>
void ParticleSplitting<Dim>::merge(Body<Dim>& body) {
  const auto pairs = pairs_to_merge(body);
  if (pairs.empty()) return;
  std::vector<bool> gone(body.particles.size(), false);
  for (const Pair& pair : pairs) merge_pair(body, pair), gone[pair.second] = true;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) kept.push_back(i);
  body.particles.reorder(kept);
  body.refresh();
  merged_ += static_cast<std::int64_t>(pairs.size());
}

// Particles that may merge, in the order of their cells and numbers.
template <int Dim>
std::vector<CellParticle> ParticleSplitting<Dim>::small_ones(Body<Dim>& body) const {
  auto& particles = body.particles;
  const double* loaded = body.load_set ? particles[body.load_set] : nullptr;
  std::vector<CellParticle> out;
  for (std::uint32_t i = 0; i < particles.size(); ++i)
    if (!(loaded && loaded[i] != 0.0) && particles.volume()[i] < largest_pair(body, i))
      out.push_back({system_.lattice.cell_number(particles.position(i)), particles.id[i], i});
  std::sort(out.begin(), out.end());
  return out;
}

// A pair must not be larger than a particle at the start of the run that has not been split.
template <int Dim>
double ParticleSplitting<Dim>::largest_pair(Body<Dim>& body, std::uint32_t i) {
  const auto generation = static_cast<int>(body.particles[body.generation][i]);
  return 1.1 * std::ldexp(body.particles.mass()[i] / body.law->density(), generation);
}

// Two particles of a cell merge if one is the neighbour of the other along its shortest axis and if the pair is not
// longer than three quarters of the limit.
template <int Dim>
auto ParticleSplitting<Dim>::pairs_to_merge(Body<Dim>& body) const -> std::vector<Pair> {
  const std::vector<CellParticle> candidates = small_ones(body);
  std::vector<Pair> pairs;
  std::vector<bool> taken(body.particles.size(), false);
  for (auto a = candidates.begin(); a != candidates.end(); ++a) {
    if (taken[a->particle]) continue;
    const auto end = std::find_if(a, candidates.end(), [&](const CellParticle& b) { return b.cell != a->cell; });
    if (const auto partner = partner_of(body, a->particle, {a + 1, end}, taken))
      pairs.emplace_back(a->particle, *partner), taken[a->particle] = taken[*partner] = true;
  }
  return pairs;
}

template <int Dim>
std::optional<std::uint32_t> ParticleSplitting<Dim>::partner_of(Body<Dim>& body, std::uint32_t i,
                                                                std::span<const CellParticle> others,
                                                                const std::vector<bool>& taken) const {
  const Vec<Dim>& cell = system_.lattice.spacing;
  auto& particles = body.particles;
  const double *mass = particles.mass(), *volume = particles.volume();
  const double* bond = body.contact_bond ? particles[body.contact_bond] : nullptr;
  const auto axes = reduced<Dim>({DomainReader<Dim>(body)(i).axes, initial_axes(body, i)}, cell).current;
  Vec<Dim> edge = edges<Dim>(axes, cell);
  int axis;
  edge.minCoeff(&axis);
  edge[axis] *= 2;
  if (edge.maxCoeff() > 0.75 * spec_->longest) return {};
  // In units of the edges the next neighbour along the axis is at distance one.
  const Mat<Dim> to_edges = (2 * axes).inverse();
  std::optional<std::uint32_t> partner;
  double nearest = 0.75;
  for (const auto& [its_cell, id, j] : others) {
    const bool alike = mass[j] < 2.01 * mass[i] && mass[i] < 2.01 * mass[j] && !(bond && bond[i] != bond[j]);
    if (taken[j] || !alike || volume[i] + volume[j] > largest_pair(body, i)) continue;
    Vec<Dim> apart = to_edges * (particles.position(j) - particles.position(i));
    apart[axis] = std::max(std::abs(apart[axis]) - 1, 0.0);
    if (apart.norm() < nearest) nearest = apart.norm(), partner = j;
  }
  return partner;
}

template <int Dim>
auto ParticleSplitting<Dim>::content(Body<Dim>& body, std::uint32_t i) const -> Content {
  const Measures m = measure_particle(body, i, false);
  return {m.kinetic, m.stored};
}

// The first particle of the pair becomes the sum of both.
template <int Dim>
void ParticleSplitting<Dim>::merge_pair(Body<Dim>& body, const Pair& pair) {
  auto& particles = body.particles;
  const auto [i, j] = pair;
  const Vec<Dim>& cell = system_.lattice.spacing;
  const Content of_one = content(body, i), of_other = content(body, j);
  const double mass = particles.mass()[i] + particles.mass()[j], share = particles.mass()[j] / mass;
  const double volume = particles.volume()[i] + particles.volume()[j];
  const double stress_share = particles.volume()[j] / volume;
  const Vec<Dim> apart = particles.position(j) - particles.position(i);
  const Vec<Dim> faster = particles.velocity(j) - particles.velocity(i);

  auto basis = reduced<Dim>({DomainReader<Dim>(body)(i).axes, initial_axes(body, i)}, cell);
  int axis;
  edges<Dim>(basis.current, cell).minCoeff(&axis);
  basis.current.col(axis) *= mass / particles.mass()[i], basis.initial.col(axis) *= mass / particles.mass()[i];

  const auto stress = particles.stress();
  const auto is_stress = [&](const double* column) {
    return std::find(stress.begin(), stress.end(), column) != stress.end();
  };
  const double generation = std::min(particles[body.generation][i], particles[body.generation][j]) - 1;
  for (std::size_t k = 0; k < particles.columns().size(); ++k) {
    double* column = particles.column(k);
    column[i] += (is_stress(column) ? stress_share : share) * (column[j] - column[i]);
  }
  particles.mass()[i] = mass, particles.volume()[i] = volume;
  particles[body.generation][i] = generation;
  set_initial_axes(body, i, basis.initial);
  scale_deformation(body, i);
  // The affine velocity field takes up the angular momentum of the relative motion.
  if (body.affine)
    for (std::size_t k = 0; k < Dim * Dim; ++k) {
      const auto r = static_cast<Eigen::Index>(k / Dim), c = static_cast<Eigen::Index>(k % Dim);
      particles[body.affine][k][i] += share * (1 - share) * faster[r] * apart[c];
    }
  const Content left = content(body, i);
  const double kinetic = of_one.kinetic + of_other.kinetic - left.kinetic;
  ledger_.damping_work += kinetic + of_one.stored + of_other.stored - left.stored;
  ledger_.particle_loss += kinetic;
}

template DomainBasis<2> reduced(DomainBasis<2>, const Vec<2>&);
template DomainBasis<3> reduced(DomainBasis<3>, const Vec<3>&);
template class ParticleSplitting<2>;
template class ParticleSplitting<3>;

}  // namespace tribo
