// SPDX-License-Identifier: MIT
#include "solver/transfer/b_bar.hpp"

#include "grid/loops.hpp"

namespace tribo {

template <int Dim>
BBar<Dim>::BBar(const Scheme& scheme, System<Dim>& system, const Transfers<Dim>& transfers,
                const Exchanges<Dim>& exchanges, Distribution<Dim>& distribution)
    : system_(system), transfers_(transfers), exchanges_(exchanges), distribution_(distribution) {
  if (scheme.b_bar) cells_ = make_cell_transfers<Dim>(scheme);
}

template <int Dim>
void BBar<Dim>::locate() {
  if (!cells_) return;
  for (auto& field : system_.fields) field.cells.resize(field.nodes.size());
}

template <int Dim>
template <class N>
void BBar<Dim>::average_rates(Gather& what, AlignedVector<N> Field<Dim>::*layer) {
  if (!cells_ || !(what.strain_dt > 0)) return;
  what.b_bar = true;
  Gather rate;
  rate.task = GatherTask::volume_rate;
  rate.from_start = what.from_start;
  rate.axisymmetric = what.axisymmetric;
  for (auto& body : system_.bodies) {
    transfers_.gather(body, Target<Dim>(body, system_.fields, layer), rate);
    average(body, what.from_start);
  }
}

// Stores the difference between the cell mean and the mean stress of the particle in the volumetric column.
template <int Dim>
void BBar<Dim>::average_stress() {
  if (!cells_) return;
  const bool three = Dim == 3 || system_.analysis == Analysis::axisymmetric;
  for (auto& body : system_.bodies) {
    const auto stress = body.particles.stress();
    double* part = body.particles[body.volumetric];
    const auto own = [&](std::size_t i) {
      return three ? (stress[0][i] + stress[1][i] + stress[2][i]) / 3 : (stress[0][i] + stress[1][i]) / 2;
    };
    each_index(body.particles.size(), [&](std::size_t i) { part[i] = own(i); });
    average(body, false);
    each_index(body.particles.size(), [&](std::size_t i) { part[i] -= own(i); });
  }
}

// Means are separate for each body, also if several bodies share a velocity field.
template <int Dim>
void BBar<Dim>::average(Body<Dim>& body, bool from_start) {
  auto& field = system_.fields[body.field];
  zero(field.cells);
  distribution_.refresh_ghosts();
  cells_->scatter(body, Target<Dim>(field.map, field.cells), Scatter::volumetric, from_start, false);
  exchanges_[body.field]->sum_images(field.cells, ImageValues::cells);
  each_node(field.cells, [](CellNode& cell) {
    if (cell.volume > 0) cell.mean = cell.sum / cell.volume;
  });
  exchanges_[body.field]->copy_images(field.cells, ImageValues::cells);
  Gather mean;
  mean.task = GatherTask::cell_mean;
  mean.from_start = from_start;
  cells_->gather(body, Target<Dim>(field.map, field.cells), mean);
}

template void BBar<2>::average_rates(Gather&, AlignedVector<Node> Field<2>::*);
template void BBar<3>::average_rates(Gather&, AlignedVector<Node> Field<3>::*);
template void BBar<2>::average_rates(Gather&, AlignedVector<FilterNode> Field<2>::*);
template void BBar<3>::average_rates(Gather&, AlignedVector<FilterNode> Field<3>::*);
template class BBar<2>;
template class BBar<3>;

}  // namespace tribo
