// SPDX-License-Identifier: MIT
#include "solver/opening_average.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Number of a cell in a table with `edge` cells along each axis.
template <int Dim>
std::size_t cell_number(const Index<Dim>& cell, int edge) {
  std::size_t number = 0;
  for (std::size_t d = Dim; d-- > 0;)
    number = number * static_cast<std::size_t>(edge) + static_cast<std::size_t>(cell[d]);
  return number;
}

}  // namespace

template <int Dim>
OpeningAverage<Dim>::OpeningAverage(const Model& model, System<Dim>& system, Distribution<Dim>& distribution)
    : system_(system), distribution_(distribution), plane_stress_(model.analysis == Analysis::plane_stress) {}

template <int Dim>
void OpeningAverage<Dim>::apply() {
  if (plane_stress_) return;
  open_bodies_.clear();
  for (auto& body : system_.bodies)
    if (const auto law = body.law->opening(); law && any_rank(any_open(body, law->column)))
      open_bodies_.push_back(&body);
  if (open_bodies_.empty()) return;
  distribution_.refresh_ghosts();
  for (Body<Dim>* body : open_bodies_) {
    const auto law = body->law->opening();
    const std::size_t bins = body->bins.with_ghosts().size();
    if (volumes_.size() < bins) volumes_.resize(bins);
    parallel_for(static_cast<std::ptrdiff_t>(bins),
                 [&](std::ptrdiff_t b) { sum_volumes(*body, law->column, static_cast<std::size_t>(b)); });
    parallel_for(static_cast<std::ptrdiff_t>(body->bins.list().size()),
                 [&](std::ptrdiff_t b) { set_openings(*body, *law, static_cast<std::size_t>(b)); });
  }
}

template <int Dim>
bool OpeningAverage<Dim>::any_open(Body<Dim>& body, std::size_t column) {
  const auto bins = body.bins.list();
  const double* opening = body.history_columns[column];
  open_.resize(bins.size());
  parallel_for(static_cast<std::ptrdiff_t>(bins.size()), [&](std::ptrdiff_t b) {
    const Bin& bin = bins[static_cast<std::size_t>(b)];
    open_[static_cast<std::size_t>(b)] =
        std::any_of(opening + bin.begin, opening + bin.end, [](double o) { return o > 0; });
  });
  return std::any_of(open_.begin(), open_.end(), [](char open) { return open != 0; });
}

template <int Dim>
void OpeningAverage<Dim>::sum_volumes(Body<Dim>& body, std::size_t column, std::size_t bin) {
  const Bin& range = body.bins.with_ghosts()[bin];
  const double* opening = body.history_columns[column];
  const double* volume = body.particles.volume();
  const Index<Dim> block = system_.lattice.block_at(range.block);
  auto& cells = volumes_[bin];
  cells.fill({});
  for (std::size_t i = range.begin; i < range.end; ++i) {
    CellVolume& cell = cells[place_of(body, block, i)];
    cell.open += volume[i], cell.closed += opening[i] > 0 ? volume[i] * std::exp(-opening[i]) : volume[i];
  }
}

// The volumes in the cells of a bin, with the particles of other bins in them, in the order of the bins.
template <int Dim>
auto OpeningAverage<Dim>::cell_volumes(const Bins<Dim>& all, std::size_t bin) const -> CellVolumes {
  const Lattice<Dim>& lattice = system_.lattice;
  const auto bins = all.with_ghosts();
  const Index<Dim> block = lattice.block_at(bins[bin].block);
  CellVolumes sums{};
  Index<Dim> low, high;
  for (std::size_t d = 0; d < Dim; ++d)
    low[d] = std::max(block[d] - 1, 0), high[d] = std::min(block[d] + 1, lattice.blocks[d] - 1);
  each_in_box<Dim>(low, high, [&](const Index<Dim>& other) {
    const std::int64_t number = lattice.block_index(other);
    const auto& sorted = all.by_block();
    const auto found = std::ranges::lower_bound(sorted, number, {}, [&](std::uint32_t b) { return bins[b].block; });
    if (found == sorted.end() || bins[*found].block != number) return;
    const auto& cells = volumes_[*found];
    // the cells that both tables contain, in those of this bin
    Index<Dim> first, last, offset;
    for (std::size_t d = 0; d < Dim; ++d) {
      offset[d] = (other[d] - block[d]) * block_edge<Dim>;
      first[d] = std::max(0, offset[d]), last[d] = std::min(edge - 1, offset[d] + edge - 1);
    }
    each_in_box<Dim>(first, last, [&](const Index<Dim>& cell) {
      Index<Dim> there;
      for (std::size_t d = 0; d < Dim; ++d) there[d] = cell[d] - offset[d];
      CellVolume& sum = sums[cell_number<Dim>(cell, edge)];
      const CellVolume& part = cells[cell_number<Dim>(there, edge)];
      sum.open += part.open, sum.closed += part.closed;
    });
  });
  return sums;
}

template <int Dim>
void OpeningAverage<Dim>::set_openings(Body<Dim>& body, const Material::Opening& law, std::size_t bin) const {
  const Bin& range = body.bins.list()[bin];
  const auto cells = cell_volumes(body.bins, bin);
  std::array<double, size> openings;
  bool any = false;
  for (std::size_t c = 0; c < size; ++c) {
    openings[c] = cells[c].open > cells[c].closed ? std::log(cells[c].open / cells[c].closed) : 0.0;
    any = any || openings[c] > 0;
  }
  if (!any) return;
  const Index<Dim> block = system_.lattice.block_at(range.block);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const double opening = openings[place_of(body, block, i)];
    if (opening > 0) set(body, law, i, opening);
  }
}

template <int Dim>
void OpeningAverage<Dim>::set(Body<Dim>& body, const Material::Opening& law, std::size_t i, double opening) {
  auto& particles = body.particles;
  double& own = body.history_columns[law.column][i];
  const double change = opening - own;
  own = opening;
  particles.volume()[i] *= std::exp(change);
  if (particles.has_deformation()) {
    const double stretch = std::exp(change / Dim);
    const auto F = particles.F();
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) F[static_cast<std::size_t>(r * Dim + c)][i] *= stretch;
  }
  const auto stress = particles.stress();
  const double pressure = -(stress[0][i] + stress[1][i] + stress[2][i]) / 3;
  const double closing = pressure > 0 && law.bulk_modulus > 0 ? std::min(opening, pressure / law.bulk_modulus) : 0.0;
  if (law.plastic_volume) body.history_columns[*law.plastic_volume][i] += change - closing;
  if (!(closing > 0)) return;
  own -= closing;
  for (std::size_t k = 0; k < 3; ++k) stress[k][i] += law.bulk_modulus * closing;
  if (body.law->dissipation_index() < 0) return;
  const double J = particles.volume()[i] * body.law->density() / particles.mass()[i];
  body.history_columns[static_cast<std::size_t>(body.law->dissipation_index())][i] +=
      J * closing * (pressure - 0.5 * law.bulk_modulus * closing);
}

// Number of the cell of a particle in the table of its bin.
template <int Dim>
std::size_t OpeningAverage<Dim>::place_of(Body<Dim>& body, const Index<Dim>& block, std::size_t i) const {
  const Lattice<Dim>& lattice = system_.lattice;
  const auto x = body.particles.x();
  Index<Dim> cell;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    const auto at = static_cast<int>(std::floor((x[d][i] - lattice.origin[axis]) / lattice.spacing[axis]));
    cell[d] = std::clamp(at - block[d] * block_edge<Dim> + before, 0, edge - 1);
  }
  return cell_number<Dim>(cell, edge);
}

template class OpeningAverage<2>;
template class OpeningAverage<3>;

}  // namespace tribo
