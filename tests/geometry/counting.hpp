// SPDX-License-Identifier: MIT
/// Area or volume of a shape by counting lattice points, with a bound on the error.
#pragma once

#include "geometry/region.hpp"

#include <catch2/catch.hpp>

#include <cmath>

/// Cells of size h whose centre is inside.
inline double counted(const tribo::Region& region, int dimension, double h) {
  const auto b = region.bounds();
  double sum = 0.0;
  // An offset that is no simple fraction keeps centres off the faces.
  const auto steps = [&](int k) { return static_cast<int>(std::ceil((b.high[k] - b.low[k]) / h)) + 2; };
  const auto at = [&](int k, int i) { return b.low[k] + (i - 0.6180339887) * h; };
  const int layers = dimension == 3 ? steps(2) : 1;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < steps(1); ++j)
      for (int i = 0; i < steps(0); ++i)
        if (region.contains(tribo::Vec3(at(0, i), at(1, j), dimension == 3 ? at(2, k) : 0.0))) sum += 1.0;
  return sum * std::pow(h, dimension);
}

/// The shape's own measure against counting, for a shape whose edge or surface is `surface` large. What is counted
/// wrongly lies within half a cell's diagonal of the surface, so |error| <= surface h sqrt(d)/2; the margin asks for
/// less, as the signs mix.
inline void check_measure(const tribo::Region& region, int dimension, double surface, double h) {
  REQUIRE(region.measure().has_value());
  CHECK(counted(region, dimension, h) ==
        Approx(*region.measure()).margin(dimension == 2 ? surface * h * 0.5 : surface * h * 0.25));
}
