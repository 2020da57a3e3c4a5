// SPDX-License-Identifier: MIT
/// Shape functions along one axis; their products are the shape functions of the grid. Distances are in cells.
///
/// `at(r, l, w, g)`: r is the position relative to the lowest node of the stencil, l the half width of the particle
/// domain, w and g the weights and gradients of the `width` nodes of the stencil. T is a double or a short vector of
/// doubles (several particles).
#pragma once

namespace tribo {

/// Linear shape functions (hats), 1 - |s|.
struct LinearKernel {
  static constexpr int width = 2;
  static constexpr double shift = 0.0;  ///< base = floor(position in cells - shift)
  static constexpr bool sized = false;
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

}  // namespace tribo
