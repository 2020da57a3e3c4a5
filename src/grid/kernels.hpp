/// Shape functions along one axis; products of them make the stencils. Distances in cells.
///
/// Each kernel gives the lowest node of its stencil (`base`) and, for a batch of points, weights and slopes of the
/// `width` nodes from there. A lambda over points keeps the loops vectorisable.
#pragma once

#include <cmath>

namespace tribo {

/// Hat functions. Weights 1 - |s|.
struct LinearKernel {
  static constexpr int width = 2;
  static constexpr double shift = 0.0;  ///< base = floor(position in cells - shift)
  static constexpr bool sized = false;
  /// r: position minus base, in [0, 1).
  static void at(double r, double, double* w, double* g) {
    w[0] = 1 - r, w[1] = r;
    g[0] = -1, g[1] = 1;
  }
};

/// Quadratic B-splines, C1. Steffen, Kirby & Berzins, Int. J. Numer. Meth. Engng 76 (2008) 922-948.
struct QuadraticKernel {
  static constexpr int width = 3;
  static constexpr double shift = 0.5;
  static constexpr bool sized = false;
  /// r in [0.5, 1.5).
  static void at(double r, double, double* w, double* g) {
    const double a = 1.5 - r, b = r - 1.0, c = r - 0.5;
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
  static void at(double r, double, double* w, double* g) {
    const double t = r - 1.0, u = 1.0 - t;
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
  static void at(double r, double l, double* w, double* g) {
    const double s = r - 1.0;  // from the middle node, in [-1/2, 1/2)
    // Parts of the domain left and right of the middle node; outside [-l, l] one of them is empty.
    const double inner = 0.25 / l;
    const double below = std::fmax(l - s, 0.0), above = std::fmax(l + s, 0.0);
    const double c = std::fabs(s) < l ? 1.0 : 0.0;
    w[0] = c * inner * below * below + (1 - c) * std::fmax(-s, 0.0);
    w[2] = c * inner * above * above + (1 - c) * std::fmax(s, 0.0);
    w[1] = 1 - w[0] - w[2];
    g[0] = -(c * 2 * inner * below + (1 - c) * (s < 0 ? 1.0 : 0.0));
    g[2] = c * 2 * inner * above + (1 - c) * (s < 0 ? 0.0 : 1.0);
    g[1] = -g[0] - g[2];
  }
};

}  // namespace tribo
