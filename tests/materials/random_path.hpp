// SPDX-License-Identifier: MIT
/// Random strain paths for plastic laws.
#pragma once

#include "material_point.hpp"

#include <random>

namespace tribo::test {

/// Drives `paths` points through `steps` random steps of up to `size` strain, with rotation, and calls
/// after(point, dissipation before the step) after each.
template <class After>
void random_paths(const Material& law, int paths, int steps, double size, After&& after) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  for (int path = 0; path < paths; ++path) {
    MaterialPoint<3> point(law);
    const double scale = size * std::pow(10.0, -3.0 * std::uniform_real_distribution<double>(0, 1)(random));
    for (int step = 0; step < steps; ++step) {
      Mat3 L;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) L(r, c) = scale * normal(random);
      // a gas or a soil would leave its range if volumes wandered far
      L -= 0.5 * std::log(point.F.determinant()) / 3 * Mat3::Identity();
      const double before = point.history_value("dissipation");
      point.step(L, 1.0);
      after(point, before);
    }
  }
}

}  // namespace tribo::test
