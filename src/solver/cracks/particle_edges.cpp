// SPDX-License-Identifier: MIT
#include "solver/cracks/particle_edges.hpp"

#include "solver/state/particle_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tribo {
namespace {

constexpr double round_off = 1e-6;  // [cells]

// The axis to which the plane through the points is normal; empty: to none.
template <int Dim>
std::optional<Eigen::Index> normal_axis(const Vec<Dim>& low, const Vec<Dim>& high, double cell) {
  for (Eigen::Index axis = 0; axis < Dim; ++axis)
    if (high[axis] - low[axis] < round_off * cell) return axis;
  return std::nullopt;
}

// Whether the half axes of a domain are along the grid axes.
template <int Dim>
bool is_aligned(const ParticleDomain<Dim>& domain) {
  for (Eigen::Index row = 0; row < Dim; ++row)
    for (Eigen::Index column = 0; column < Dim; ++column)
      if (row != column && std::abs(domain.axes(row, column)) > round_off * std::abs(domain.axes(column, column)))
        return false;
  return true;
}

}  // namespace

template <int Dim>
Vec<Dim> shift_to_particle_edges(System<Dim>& system, const std::vector<Vec<Dim>>& points) {
  const Vec<Dim> stays = Vec<Dim>::Zero();
  Vec<Dim> low = points.front(), high = low;
  for (const Vec<Dim>& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double cell = system.lattice.spacing.maxCoeff(), slack = round_off * cell;
  const auto axis = normal_axis<Dim>(low, high, cell);
  if (!axis) return stays;
  const double at = low[*axis];
  // Lowest and highest position of the edges on either side
  double below[2] = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double above[2] = {below[0], below[1]};
  bool touches = false;  // the edge of a particle
  for (auto& body : system.bodies) {
    const DomainReader<Dim> domains(body);
    const auto x = body.particles.x();
    for (std::uint32_t i = 0; i < body.particles.size(); ++i) {
      if (std::abs(x[static_cast<std::size_t>(*axis)][i] - at) > 2 * cell) continue;
      const ParticleDomain<Dim> domain = domains(i);
      bool beside = false;
      for (Eigen::Index d = 0; d < Dim; ++d)
        beside = beside || (d != *axis && (domain.x[d] < low[d] || domain.x[d] > high[d]));
      const double half = domain.axes.row(*axis).cwiseAbs().sum();
      if (beside || std::abs(domain.x[*axis] - at) > half + slack) continue;
      if (!is_aligned(domain)) return stays;
      if (std::abs(domain.x[*axis] - at) > half - slack) {
        touches = true;
        continue;
      }
      below[0] = std::min(below[0], domain.x[*axis] - half), below[1] = std::max(below[1], domain.x[*axis] - half);
      above[0] = std::min(above[0], domain.x[*axis] + half), above[1] = std::max(above[1], domain.x[*axis] + half);
    }
  }
  if (touches || !(below[0] <= below[1]) || below[1] - below[0] > slack || above[1] - above[0] > slack) return stays;
  const double down = below[0] - at, up = above[0] - at;
  Vec<Dim> shift = stays;
  shift[*axis] = up <= -down + slack ? up : down;
  return shift;
}

template Vec<2> shift_to_particle_edges(System<2>&, const std::vector<Vec<2>>&);
template Vec<3> shift_to_particle_edges(System<3>&, const std::vector<Vec<3>>&);

}  // namespace tribo
