// SPDX-License-Identifier: MIT
#include "solver/transfer/affine_at_walls.hpp"

#include <cmath>

namespace tribo {
namespace {

// Second moment of the shape functions, sum w (x_i - x)^2 [cells^2].
constexpr double second_moment(const QuadraticKernel&) { return 0.25; }
constexpr double second_moment(const CubicKernel&) { return 1.0 / 3; }

}  // namespace

template <int Dim>
AffineAtWalls<Dim>::AffineAtWalls(const Model& model, const Lattice<Dim>& lattice)
    : lattice_(lattice), kernel_(model.scheme.kernel) {
  const bool spline = kernel_ == Kernel::quadratic_spline || kernel_ == Kernel::cubic_spline;
  if (model.scheme.transfer != Transfer::apic || !spline) return;
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t side = 0; side < 2; ++side)
      if (const auto& at = model.grid.wall[axis][side])
        walls_.push_back({axis, lattice.line(static_cast<int>(axis), *at), side == 0 ? 1 : -1});
}

// Whether particles of a bin may reach the nodes beyond a wall, also after they moved by less than a cell.
template <int Dim>
bool AffineAtWalls<Dim>::near(const Bin& bin, const Wall& wall) const {
  constexpr int reach = 4;  // nodes of a stencil with the drift
  const int low = lattice_.block_at(bin.block)[wall.axis] * block_edge<Dim>;
  return wall.node >= low - reach && wall.node <= low + block_edge<Dim> + reach;
}

// `momentum`: the affine momentum over one cell along the axis d of the wall, m h C e_d.
template <int Dim>
template <class Spline>
void AffineAtWalls<Dim>::add_particle(const Wall& wall, const Vec<Dim>& x, const Vec<Dim>& momentum,
                                      const BlockMap<Dim>& map, NodeLayer& nodes) const {
  const Index<Dim> wall_index = [&] {
    Index<Dim> index{};
    index[wall.axis] = wall.node;
    return index;
  }();
  const auto axis = static_cast<Eigen::Index>(wall.axis);
  const double inside = wall.inward * (x[axis] - lattice_.position(wall_index)[axis]) / lattice_.spacing[axis];
  const double beyond = Spline::value(std::abs(inside + 1));
  if (!(beyond > 0)) return;
  // Lowest node of the stencil along the other axes.
  const Vec<Dim> cells = (x - lattice_.position(Index<Dim>{})).cwiseQuotient(lattice_.spacing);
  Index<Dim> low{}, high{};
  for (std::size_t d = 0; d < Dim; ++d) {
    low[d] = d == wall.axis ? 0 : static_cast<int>(std::floor(cells[static_cast<Eigen::Index>(d)] - Spline::shift));
    high[d] = d == wall.axis ? 0 : low[d] + Spline::width - 1;
  }
  each_in_box<Dim>(low, high, [&](Index<Dim> node) {
    double w = beyond;
    for (std::size_t d = 0; d < Dim; ++d)
      if (d != wall.axis) w *= Spline::value(std::abs(cells[static_cast<Eigen::Index>(d)] - node[d]));
    // The node beyond the wall has the weights 2 and -1 for the nodes on the wall and next to it, which are one and two
    // cells away from it.
    const Vec<Dim> change = 2 * w * wall.inward * momentum;
    for (const int layer : {0, 1}) {
      node[wall.axis] = wall.node + layer * wall.inward;
      const std::int64_t at = map.node(node);
      if (at < 0) continue;
      Eigen::Map<Vec<Dim>>(nodes[static_cast<std::size_t>(at)].momentum) += layer == 0 ? change : Vec<Dim>(-change);
    }
  });
}

template <int Dim>
void AffineAtWalls<Dim>::add(Body<Dim>& body, const BlockMap<Dim>& map, NodeLayer& nodes, bool from_start) const {
  if (walls_.empty() || !body.affine) return;
  const auto x = from_start ? body.particles[body.start] : body.particles.x();
  const auto affine = body.particles[body.affine];
  const double* mass = body.particles.mass();
  const auto add_bin = [&](const Bin& bin, const Wall& wall, auto kernel) {
    const double h = lattice_.spacing[static_cast<Eigen::Index>(wall.axis)];
    for (std::uint32_t p = bin.begin; p < bin.end; ++p) {
      Vec<Dim> at, column;
      for (std::size_t d = 0; d < Dim; ++d) {
        at[static_cast<Eigen::Index>(d)] = x[d][p];
        column[static_cast<Eigen::Index>(d)] = affine[d * Dim + wall.axis][p];
      }
      const Vec<Dim> momentum = mass[p] / (second_moment(kernel) * h) * column;
      add_particle<decltype(kernel)>(wall, at, momentum, map, nodes);
    }
  };
  for (const Wall& wall : walls_)
    for (const std::uint32_t k : body.bins.by_block()) {
      const Bin& bin = body.bins.with_ghosts()[k];
      if (!near(bin, wall) || body.cut_bin(k) != nullptr) continue;
      if (kernel_ == Kernel::quadratic_spline)
        add_bin(bin, wall, QuadraticKernel{});
      else
        add_bin(bin, wall, CubicKernel{});
    }
}

template class AffineAtWalls<2>;
template class AffineAtWalls<3>;

}  // namespace tribo
