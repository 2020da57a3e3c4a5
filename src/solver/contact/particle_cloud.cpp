// SPDX-License-Identifier: MIT
#include "solver/contact/particle_cloud.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tribo {

template <int Dim>
ParticleCloud<Dim>::ParticleCloud(const Lattice<Dim>& lattice, double reach, MirrorPlanes<Dim> planes)
    : lattice_(lattice), planes_(std::move(planes)), reach_(reach), per_length_(lattice.spacing.cwiseInverse()) {
  Index<Dim> cells;
  int count = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    cells[d] = static_cast<int>(std::ceil(reach / lattice.spacing[static_cast<Eigen::Index>(d)] - 1e-9));
    count *= 2 * cells[d];
  }
  for (int k = 0; k < count; ++k) {
    Index<Dim> offset;
    Vec<Dim> nearest;
    int rest = k;
    for (std::size_t d = 0; d < Dim; ++d) {
      offset[d] = rest % (2 * cells[d]) - cells[d];
      rest /= 2 * cells[d];
      nearest[static_cast<Eigen::Index>(d)] = offset[d] < 0 ? offset[d] + 1 : offset[d];
    }
    if (nearest.cwiseProduct(lattice.spacing).norm() <= reach) offsets_.push_back(offset);
  }
  for (std::size_t k = 0; k < near_cells_.size(); ++k)
    for (int cell = 0; cell < block_nodes<Dim>; ++cell) {
      bool near = true;
      std::size_t block = k;
      int rest = cell;
      for (int d = 0; d < Dim; ++d, block /= 3, rest /= block_edge<Dim>) {
        const int at = (static_cast<int>(block % 3) - 1) * block_edge<Dim> + rest % block_edge<Dim>;
        near = near && at >= -1 && at < block_edge<Dim> + 2;
      }
      if (near) near_cells_[k] |= std::uint64_t{1} << cell;
    }
}

template <int Dim>
void ParticleCloud<Dim>::release() {
  requested_.clear(), requested_.shrink_to_fit();
  find_cells();
  for (auto* labels : {&labels_, &unsorted_}) labels->clear(), labels->shrink_to_fit();
  for (auto* numbers : {&cell_of_, &first_, &start_}) numbers->clear(), numbers->shrink_to_fit();
  for (auto& column : column_) column.clear(), column.shrink_to_fit();
  groups_.clear(), groups_.shrink_to_fit();
}

// Finds the blocks with cells within reach of the requested nodes, and marks these cells.
template <int Dim>
void ParticleCloud<Dim>::find_cells() {
  BlockBox<Dim> box;
  for (const Index<Dim>& node : requested_) each_cell(node, [&](const Index<Dim>& block, int) { box.include(block); });
  slot_.reset(box), mask_.clear();
  for (const Index<Dim>& node : requested_)
    each_cell(node, [&](const Index<Dim>& block, int cell) {
      int& s = slot_.at(block);
      if (s < 0) s = static_cast<int>(mask_.size()), mask_.push_back(0);
      mask_[static_cast<std::size_t>(s)] |= std::uint64_t{1} << cell;
    });
}

// Whether a point lies in a requested cell, and in which.
template <int Dim>
bool ParticleCloud<Dim>::is_requested(const Vec<Dim>& x, std::size_t& at) const {
  Index<Dim> block;
  int local = 0;
  for (std::size_t d = Dim; d-- > 0;) {
    const auto axis = static_cast<Eigen::Index>(d);
    constexpr unsigned edge = block_edge<Dim>;
    // huge for cells below the lattice
    const auto cell = static_cast<unsigned>(static_cast<int>((x[axis] - lattice_.origin[axis]) * per_length_[axis]));
    if (cell >= static_cast<unsigned>(lattice_.blocks[d]) * edge) return false;
    block[d] = static_cast<int>(cell / edge);
    local = local * static_cast<int>(edge) + static_cast<int>(cell % edge);
  }
  const int s = slot_[block];
  if (s < 0 || !(mask_[static_cast<std::size_t>(s)] >> local & 1)) return false;
  at = static_cast<std::size_t>(s) * block_nodes<Dim> + static_cast<std::size_t>(local);
  return true;
}

// Whether some cell is requested that may contain particles of the bin of a block: the cells of the block, and due to
// the drift of particles since the last sort those up to one cell below and two above.
template <int Dim>
bool ParticleCloud<Dim>::any_requested_near(std::int64_t bin_block) const {
  const auto home = lattice_.block_at(bin_block);
  Index<Dim> n = home;
  for (std::size_t k = 0; k < near_cells_.size(); ++k) {
    std::size_t rest = k;
    for (std::size_t d = 0; d < Dim; ++d, rest /= 3) n[d] = home[d] + static_cast<int>(rest % 3) - 1;
    const int s = slot_[n];
    if (s >= 0 && (mask_[static_cast<std::size_t>(s)] & near_cells_[k]) != 0) return true;
  }
  return false;
}

template <int Dim>
void ParticleCloud<Dim>::collect(const std::vector<Body<Dim>*>& bodies) {
  find_cells();
  unsorted_.clear();
  cell_of_.clear();
  first_.assign(mask_.size() * block_nodes<Dim> + 1, 0);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Body<Dim>& body = *bodies[b];
    const auto x = body.particles.x();
    for (const std::uint32_t k : body.bins.by_block()) {
      const Bin& bin = body.bins.with_ghosts()[k];
      if (!any_requested_near(bin.block)) continue;
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
        Vec<Dim> at;
        for (std::size_t d = 0; d < Dim; ++d) at[static_cast<Eigen::Index>(d)] = x[d][i];
        std::size_t cell = 0;
        if (!is_requested(at, cell)) continue;
        const auto add = [&](std::uint32_t image) {
          unsorted_.push_back({static_cast<std::uint32_t>(body.field), static_cast<std::uint32_t>(b), i, image});
          cell_of_.push_back(static_cast<std::uint32_t>(cell));
          ++first_[cell + 1];
        };
        add(0);
        // Requests lie inside the planes, so whatever is within reach of them has a particle within reach
        for (const std::uint32_t image : planes_.images())
          if (is_requested(planes_.point(at, image), cell)) add(image);
      }
    }
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  labels_.resize(unsorted_.size());
  for (std::size_t k = unsorted_.size(); k-- > 0;) labels_[--first_[cell_of_[k] + 1]] = unsorted_[k];
  // Now first_[c + 1] is the first particle of cell c; shift it to first_[c].
  for (std::size_t c = 0; c + 1 < first_.size(); ++c) first_[c] = first_[c + 1];
  first_.back() = static_cast<std::uint32_t>(labels_.size());
  for (auto& column : column_) column.resize(labels_.size());
  domains_.clear();
  for (auto* body : bodies) domains_.emplace_back(*body);
  parallel_for(static_cast<std::ptrdiff_t>(labels_.size()), [&](std::ptrdiff_t k) {
    const auto at = static_cast<std::size_t>(k);
    const ParticleLabel& label = labels_[at];
    const ParticleDomain<Dim> p = planes_.domain(domains_[label.body](label.particle), label.image);
    for (std::size_t c = 0; c < Dim; ++c) column_[c][at] = p.x.data()[c];
    for (std::size_t c = Dim; c < column_count; ++c) column_[c][at] = p.axes.data()[c - Dim];
  });
  group();
}

// Groups the particles of each cell, which are ordered by body, by fields.
template <int Dim>
void ParticleCloud<Dim>::group() {
  groups_.clear();
  start_.resize(first_.size());
  max_extent_ = 0.0;
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    start_[cell] = static_cast<std::uint32_t>(groups_.size());
    for (std::uint32_t p = first_[cell]; p < first_[cell + 1]; ++p) {
      const ParticleDomain<Dim> particle = domain(p);
      const Vec<Dim> half = particle.axes.cwiseAbs().rowwise().sum();
      if (p == first_[cell] || groups_.back().field != labels_[p].field)
        groups_.push_back({labels_[p].field, p, p, particle.x - half, particle.x + half, Vec<Dim>::Zero()});
      ParticleGroup<Dim>& group = groups_.back();
      group.end = p + 1;
      group.low = group.low.cwiseMin(particle.x - half), group.high = group.high.cwiseMax(particle.x + half);
      group.sum += particle.x;
      max_extent_ = std::max(max_extent_, half.norm());
    }
  }
  start_.back() = static_cast<std::uint32_t>(groups_.size());
}

template <int Dim>
void ParticleCloud<Dim>::compute_reach(const ParticleGroup<Dim>& group, const Vec<Dim>& centre, const Vec<Dim>& n,
                                       double* __restrict out) const {
  std::array<const double*, column_count> from;
  for (std::size_t c = 0; c < column_count; ++c) from[c] = column_[c].data() + group.begin;
  const double limit = reach_ * reach_;
  const std::uint32_t count = group.end - group.begin;
  for (std::uint32_t i = 0; i < count; ++i) {
    double reach = 0.0, square = 0.0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double x = from[d][i] - centre[static_cast<Eigen::Index>(d)];
      reach += x * n[static_cast<Eigen::Index>(d)], square += x * x;
    }
    for (std::size_t k = 1; k <= Dim; ++k) {
      double along = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) along += from[Dim * k + d][i] * n[static_cast<Eigen::Index>(d)];
      reach += std::fabs(along);
    }
    out[i] = square <= limit ? reach : -std::numeric_limits<double>::infinity();
  }
}

template class ParticleCloud<2>;
template class ParticleCloud<3>;

}  // namespace tribo
