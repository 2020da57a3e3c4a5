// SPDX-License-Identifier: MIT
/// The nodes around a point, and the nodes that replace those beyond symmetry planes.
#pragma once

#include "grid/kernels.hpp"
#include "grid/lattice.hpp"
#include "model/model.hpp"

#include <cmath>
#include <vector>

namespace tribo {

/// A symmetry plane of the grid.
struct SymmetryPlane {
  int axis;
  double at;         ///< position on the axis                                                 [length]
  int node, inward;  ///< number of its grid line; +1 at the low end of the axis, -1 at the high end
};

/// Shape functions of the nodes around a point.
template <int Dim>
class NodesAround {
 public:
  NodesAround(const Model& model, const Lattice<Dim>& lattice)
      : reach_(reach_of(model.scheme.kernel)),
        value_(with_kernel(model.scheme.kernel, [](auto k) { return &decltype(k)::Point::value; })),
        values_(with_kernel(model.scheme.kernel, [](auto k) { return &values_along<typename decltype(k)::Point>; })),
        lattice_(lattice) {
    for (int axis = 0; axis < Dim; ++axis)
      for (std::size_t end = 0; end < 2; ++end)
        if (const auto& at = model.grid.symmetry[static_cast<std::size_t>(axis)][end])
          planes_.push_back({axis, *at, lattice.line(axis, *at), end == 0 ? 1 : -1});
  }

  const std::vector<SymmetryPlane>& planes() const { return planes_; }

  /// Shape function of a node at a point. `distance`: from the node to the point [length]. Particle domains are not
  /// considered.
  double weight(const Vec<Dim>& distance) const {
    double w = 1.0;
    for (int d = 0; d < Dim; ++d) w *= value_(std::abs(distance[d]) / lattice_.spacing[d]);
    return w;
  }

  /// The nodes around a point and their shape functions, which are products of functions along the axes.
  struct Stencil {
    static constexpr std::size_t most = 6;  ///< nodes along an axis
    static constexpr std::size_t size = Dim == 2 ? most * most : most * most * most;

    Index<Dim> low{}, high{};  ///< lowest and highest node
    std::array<std::array<double, most>, static_cast<std::size_t>(Dim)> along;

    bool has_nodes_of(const Stencil& other) const { return low == other.low && high == other.high; }
    /// Calls f(position, weight, node) for all nodes; the position in the stencil is less than `size`. Weights may be
    /// 0.
    template <class F>
    void each(F&& f) const {
      std::size_t position = 0;
      each_in_box<Dim>(low, high, [&](const Index<Dim>& n) {
        double w = 1.0;
        for (std::size_t d = 0; d < Dim; ++d) w *= along[d][static_cast<std::size_t>(n[d] - low[d])];
        f(position++, w, n);
      });
    }
  };

  /// Finds the stencil of the point x [length]. Returns false if one of its nodes lies outside of the lattice.
  bool find(const Vec<Dim>& x, Stencil& stencil) const {
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      const double s = (x[axis] - lattice_.origin[axis]) / lattice_.spacing[axis];
      stencil.low[d] = static_cast<int>(std::ceil(s - reach_));
      stencil.high[d] = static_cast<int>(std::floor(s + reach_));
      if (stencil.low[d] < 0 || stencil.high[d] >= lattice_.blocks[d] * block_edge<Dim>) return false;
      values_(s, stencil.low[d], stencil.high[d], stencil.along[d].data());
    }
    return true;
  }

  /// Calls f(weight, node) for all nodes with a positive shape function at the point x [length]. Returns false,
  /// without a call, if one of them lies outside of the lattice.
  template <class F>
  bool each(const Vec<Dim>& x, F&& f) const {
    Stencil stencil;
    if (!find(x, stencil)) return false;
    stencil.each([&](std::size_t, double w, const Index<Dim>& n) {
      if (w > 0) f(w, n);
    });
    return true;
  }

  /// Replaces a node beyond symmetry planes by the node inside of which it is the image. Returns the factors of vector
  /// components: -1 along the normals of these planes, else 1.
  Vec<Dim> fold(Index<Dim>& node) const {
    Vec<Dim> mirror = Vec<Dim>::Ones();
    for (const SymmetryPlane& plane : planes_) {
      int& at = node[static_cast<std::size_t>(plane.axis)];
      if ((plane.node - at) * plane.inward > 0) at = 2 * plane.node - at, mirror[plane.axis] *= -1;
    }
    return mirror;
  }
  /// Number of symmetry planes through a node.
  int planes_through(const Index<Dim>& node) const {
    int count = 0;
    for (const SymmetryPlane& plane : planes_) count += node[static_cast<std::size_t>(plane.axis)] == plane.node;
    return count;
  }
  /// Number of symmetry planes through a point, to round-off.
  int planes_through(const Vec<Dim>& x) const {
    int count = 0;
    for (const SymmetryPlane& plane : planes_)
      count += std::abs(x[plane.axis] - plane.at) < 1e-9 * lattice_.spacing[plane.axis];
    return count;
  }

 private:
  template <class Point>
  static void values_along(double s, int low, int high, double* out) {
    for (int n = low; n <= high; ++n) *out++ = Point::value(std::abs(s - n));
  }

  double reach_;             // radius of the support of the shape function [cells]
  double (*value_)(double);  // one-dimensional shape function of the distance [cells]
  // Those of the nodes low ... high at the coordinate s [cells].
  void (*values_)(double s, int low, int high, double* out);
  const Lattice<Dim>& lattice_;
  std::vector<SymmetryPlane> planes_;
};

}  // namespace tribo
