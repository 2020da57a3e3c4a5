#include "solver/contact_cloud.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
void Cloud<Dim>::begin(double reach) {
  reach_ = reach;
  for (std::size_t d = 0; d < Dim; ++d)
    cells_[d] = static_cast<int>(std::ceil(reach / lattice_.spacing[static_cast<Eigen::Index>(d)] - 1e-9));
  for (const auto block : blocks_) slot_[static_cast<std::size_t>(block)] = -1;
  blocks_.clear();
  mask_.clear();
}

template <int Dim>
void Cloud<Dim>::want(const Index<Dim>& node) {
  each_cell(node, [&](std::int64_t block, int cell) {
    int& s = slot_[static_cast<std::size_t>(block)];
    if (s < 0) {
      s = static_cast<int>(blocks_.size());
      blocks_.push_back(block);
      mask_.push_back(0);
    }
    mask_[static_cast<std::size_t>(s)] |= std::uint64_t{1} << cell;
  });
}

// Whether a place lies in a wanted cell, and which.
template <int Dim>
bool Cloud<Dim>::wanted(const Vec<Dim>& x, std::size_t& at) const {
  Index<Dim> block;
  int local = 0;
  for (std::size_t d = Dim; d-- > 0;) {
    const auto axis = static_cast<Eigen::Index>(d);
    const int cell = static_cast<int>((x[axis] - lattice_.origin[axis]) / lattice_.spacing[axis]);
    if (cell < 0 || cell >= lattice_.blocks[d] * block_edge<Dim>) return false;
    block[d] = cell / block_edge<Dim>;
    local = local * block_edge<Dim> + cell % block_edge<Dim>;
  }
  const int s = slot_[static_cast<std::size_t>(lattice_.block_index(block))];
  if (s < 0 || !(mask_[static_cast<std::size_t>(s)] >> local & 1)) return false;
  at = static_cast<std::size_t>(s) * block_nodes<Dim> + static_cast<std::size_t>(local);
  return true;
}

template <int Dim>
CloudPoint<Dim> Cloud<Dim>::point(Body<Dim>& body, std::uint32_t b, std::uint32_t i) const {
  CloudPoint<Dim> p;
  p.x = body.particles.position(i);
  p.field = static_cast<std::uint32_t>(body.field), p.body = b, p.particle = i;
  Vec<Dim> half = body.uniform_half_size;
  if (body.half_size)
    for (std::size_t d = 0; d < Dim; ++d)
      half[static_cast<Eigen::Index>(d)] = body.particles.column(*body.half_size + d)[i];
  p.axes = half.asDiagonal();
  if (body.particles.has_deformation()) {
    const Mat3 F = load_full<Dim>(body.particles.F(), static_cast<int>(i));
    p.axes = F.template topLeftCorner<Dim, Dim>() * p.axes;
  }
  return p;
}

template <int Dim>
void Cloud<Dim>::collect(const std::vector<Body<Dim>*>& bodies) {
  unsorted_.clear();
  cell_of_.clear();
  start_.assign(blocks_.size() * block_nodes<Dim> + 1, 0);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Body<Dim>& body = *bodies[b];
    const auto x = body.particles.x();
    for (const Bin& bin : body.bins.list()) {
      // Particles of a bin lie in its block, one cell below or up to two above.
      const auto home = lattice_.block_at(bin.block);
      bool any = false;
      Index<Dim> n = home;
      for (int k = 0; k < (Dim == 2 ? 9 : 27) && !any; ++k) {
        n[0] = home[0] + k % 3 - 1, n[1] = home[1] + k / 3 % 3 - 1;
        if constexpr (Dim == 3) n[2] = home[2] + k / 9 - 1;
        bool inside = true;
        for (std::size_t d = 0; d < Dim; ++d) inside = inside && n[d] >= 0 && n[d] < lattice_.blocks[d];
        any = inside && slot_[static_cast<std::size_t>(lattice_.block_index(n))] >= 0;
      }
      if (!any) continue;
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
        Vec<Dim> at;
        for (std::size_t d = 0; d < Dim; ++d) at[static_cast<Eigen::Index>(d)] = x[d][i];
        std::size_t cell = 0;
        if (!wanted(at, cell)) continue;
        unsorted_.push_back(point(body, static_cast<std::uint32_t>(b), i));
        cell_of_.push_back(static_cast<std::uint32_t>(cell));
        ++start_[cell + 1];
      }
    }
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  points_.resize(unsorted_.size());
  for (std::size_t k = unsorted_.size(); k-- > 0;) points_[--start_[cell_of_[k] + 1]] = unsorted_[k];
  // start_[c + 1] now is the first of cell c; bring it back to start_[c]
  for (std::size_t c = 0; c + 1 < start_.size(); ++c) start_[c] = start_[c + 1];
  start_.back() = static_cast<std::uint32_t>(points_.size());
}

template class Cloud<2>;
template class Cloud<3>;

}  // namespace tribo
