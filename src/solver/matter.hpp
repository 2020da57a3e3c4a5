/// Where there are particles.
#pragma once

#include "solver/contact_cloud.hpp"
#include "solver/nodes_around.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace tribo {

/// Tells whether a point lies in the domain of a particle.
template <int Dim>
class Matter {
 public:
  /// Within a box.
  Matter(const Model& model, System<Dim>& system, const Vec<Dim>& low, const Vec<Dim>& high)
      : lattice_(system.lattice), around_(model, system.lattice) {
    for (auto& body : system.bodies) {
      const Domains<Dim> domains(body);
      const auto x = body.particles.x();
      for (std::uint32_t i = 0; i < body.particles.size(); ++i) {
        bool near = true;
        for (std::size_t d = 0; d < Dim; ++d) {
          const auto axis = static_cast<Eigen::Index>(d);
          near = near && x[d][i] >= low[axis] && x[d][i] <= high[axis];
        }
        if (!near) continue;
        const CloudPoint<Dim> domain = domains(i);
        Vec<Dim> half = Vec<Dim>::Zero();
        for (int k = 0; k < Dim; ++k) half += domain.axes.col(k).cwiseAbs();
        half *= 1 + widest;
        each_cell(domain.x - half, domain.x + half, [&](std::int64_t cell) { cells_[cell].push_back(domain); });
      }
    }
  }
  /// Whether a point lies beyond a symmetry plane.
  bool mirrored(const Vec<Dim>& x) const {
    return std::any_of(around_.planes().begin(), around_.planes().end(),
                       [&](const SymmetryPlane& plane) { return (plane.at - x[plane.axis]) * plane.inward > 0; });
  }
  /// `slack`: parts of a particle's size by which a point may lie beside it, up to a half.
  bool at(Vec<Dim> x, double slack = 1e-9) const {
    for (const SymmetryPlane& plane : around_.planes())
      if ((plane.at - x[plane.axis]) * plane.inward > 0) x[plane.axis] = 2 * plane.at - x[plane.axis];
    bool found = false;
    each_cell(x, x, [&](std::int64_t cell) {
      const auto domains = cells_.find(cell);
      if (domains == cells_.end()) return;
      for (const auto& d : domains->second)
        found = found || d.axes.inverse().operator*(x - d.x).cwiseAbs().maxCoeff() <= 1 + 2 * slack;
    });
    return found;
  }

 private:
  static constexpr double widest = 1.0;

  template <class F>
  void each_cell(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const {
    Index<Dim> first, last;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      const auto cell = [&](double at) {
        return static_cast<int>(std::floor((at - lattice_.origin[axis]) / lattice_.spacing[axis]));
      };
      first[d] = cell(low[axis]), last[d] = cell(high[axis]);
    }
    for (int z = Dim == 3 ? first[Dim - 1] : 0; z <= (Dim == 3 ? last[Dim - 1] : 0); ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          constexpr std::int64_t row = std::int64_t{1} << 20;
          f((z * row + y) * row + x);
        }
  }

  const Lattice<Dim>& lattice_;
  NodesAround<Dim> around_;
  std::unordered_map<std::int64_t, std::vector<CloudPoint<Dim>>> cells_;
};

}  // namespace tribo
