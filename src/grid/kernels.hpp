// SPDX-License-Identifier: MIT
/// Shape functions along one axis; their products are the shape functions of the grid. Distances are in cells.
///
/// Each kernel has
/// - `width`: number of nodes of the stencil along the axis; `shift`: the lowest node is floor(position - shift);
/// - `sized`: whether the size of the particle's domain counts;
/// - `at(r, l, w, g)`: weights w and slopes g of the `width` nodes of the stencil, for the position r minus the lowest
/// node
///   and the half width l of the particle's domain. T is a double or a short vector of doubles (several particles);
/// - `Point`: the kernel that interpolates at points without a domain, with `reach`, the distance within which it is
/// not
///   zero, and `value(s)`, its value for a node at the distance s >= 0.
///
/// The list of all kernels is in model/shape_functions.hpp.
#pragma once

#include "model/shape_functions.hpp"

#include <stdexcept>

namespace tribo {

/// Linear shape functions (hats), 1 - |s|.
struct LinearKernel {
  static constexpr int width = 2;
  static constexpr double shift = 0.0;
  static constexpr bool sized = false;
  using Point = LinearKernel;
  static constexpr double reach = 1.0;
  static double value(double s) { return s < 1 ? 1 - s : 0.0; }
  /// r: position minus base, in [0, 1).
  template <class T>
  static void at(T r, T, T* w, T* g) {
    w[0] = 1 - r, w[1] = r;
    g[0] = T{} - 1, g[1] = T{} + 1;
  }
};

/// Quadratic B-splines, C1. Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922-948.
struct QuadraticKernel {
  static constexpr int width = 3;
  static constexpr double shift = 0.5;
  static constexpr bool sized = false;
  using Point = QuadraticKernel;
  static constexpr double reach = 1.5;
  static double value(double s) { return s <= 0.5 ? 0.75 - s * s : s < 1.5 ? 0.5 * (1.5 - s) * (1.5 - s) : 0.0; }
  /// r in [0.5, 1.5).
  template <class T>
  static void at(T r, T, T* w, T* g) {
    const T a = 1.5 - r, b = r - 1.0, c = r - 0.5;
    w[0] = 0.5 * a * a, w[1] = 0.75 - b * b, w[2] = 0.5 * c * c;
    g[0] = -a, g[1] = -2 * b, g[2] = c;
  }
};

/// Cubic B-splines, C2. Same source.
struct CubicKernel {
  static constexpr int width = 4;
  static constexpr double shift = 1.0;
  static constexpr bool sized = false;
  using Point = CubicKernel;
  static constexpr double reach = 2.0;
  static double value(double s) {
    return s <= 1 ? 2.0 / 3 - s * s * (1 - 0.5 * s) : s < 2 ? (2 - s) * (2 - s) * (2 - s) / 6 : 0.0;
  }
  /// r in [1, 2).
  template <class T>
  static void at(T r, T, T* w, T* g) {
    const T t = r - 1.0, u = 1.0 - t;
    w[0] = u * u * u / 6, w[1] = 2.0 / 3 - t * t * (1 - 0.5 * t), w[2] = 2.0 / 3 - u * u * (1 - 0.5 * u),
    w[3] = t * t * t / 6;
    g[0] = -0.5 * u * u, g[1] = t * (1.5 * t - 2), g[2] = u * (2 - 1.5 * u), g[3] = 0.5 * t * t;
  }
};

/// Uniform GIMP: hats averaged over the particle's undeformed domain of half width l <= 1/2 cell.
/// Bardenhagen & Kober, CMES 5 (2004) 477-495.
struct GimpKernel {
  static constexpr int width = 3;
  static constexpr double shift = 0.5;
  static constexpr bool sized = true;
  using Point = LinearKernel;
  /// r in [0.5, 1.5), l: half width in cells.
  template <class T>
  static void at(T r, T l, T* w, T* g) {
    const T s = r - 1.0;  // from the middle node, in [-1/2, 1/2)
    // Within l of the middle node the domain overlaps two cells and the weights are parabolas; otherwise they are
    // linear.
    const T inner = 0.25 / l, below = l - s, above = l + s;
    const auto both = below > 0 && above > 0;
    const T left = s < 0 ? -s : T{}, right = s < 0 ? T{} : s;
    w[0] = both ? inner * below * below : left;
    w[2] = both ? inner * above * above : right;
    w[1] = 1 - w[0] - w[2];
    g[0] = both ? -2 * inner * below : (s < 0 ? T{} - 1 : T{});
    g[2] = both ? 2 * inner * above : (s < 0 ? T{} : T{} + 1);
    g[1] = -g[0] - g[2];
  }
};

/// CPDI evaluates hats at the corners of the particle's domain, see solver/transfer/cpdi_transfer.hpp.
struct CpdiCornerKernel {
  using Point = LinearKernel;
};

/// Weight 1 at the lowest node of the cell, with the stencil of another kernel, for sums over cells instead of nodes.
template <class Kernel>
struct CellKernel {
  static constexpr int width = Kernel::width;
  static constexpr double shift = Kernel::shift;
  static constexpr bool sized = false;
  template <class T>
  static void at(T r, T, T* w, T* g) {
    for (int n = 0; n < width; ++n) {
      w[n] = r >= n && r < n + 1 ? T{} + 1 : T{};
      g[n] = T{};
    }
  }
};

/// Calls f(K()) with the type K of a kernel and returns what f returns.
template <class F>
decltype(auto) with_kernel(Kernel kernel, F&& f) {
  switch (kernel) {
#define TRIBO_CASE(name, type, words) \
  case Kernel::name:                  \
    return f(type());
    TRIBO_SHAPE_FUNCTIONS(TRIBO_CASE)
#undef TRIBO_CASE
  }
  throw std::logic_error("no such kernel");
}

/// The distance from a node within which its shape function is not zero at points without a domain [cells].
inline double reach_of(Kernel kernel) {
  return with_kernel(kernel, [](auto k) { return decltype(k)::Point::reach; });
}

}  // namespace tribo
