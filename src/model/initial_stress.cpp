// SPDX-License-Identifier: MIT
#include "model/initial_stress.hpp"

#include <algorithm>

namespace tribo {

bool StressField::given() const {
  return points || std::any_of(functions.begin(), functions.end(), [](const auto& f) { return f.has_value(); });
}

void StressField::set(const Vec3& x, Mat3& stress) const {
  static constexpr std::array<std::array<int, 2>, 6> place{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  const auto here = Variables::at(x);
  for (std::size_t k = 0; k < 6; ++k)
    if (functions[k]) {
      const double value = (*functions[k])(here)*factor;
      stress(place[k][0], place[k][1]) = stress(place[k][1], place[k][0]) = value;
    }
  if (!points) return;
  const ScatteredField::Values v = points->at(x);
  for (std::size_t k = 0; k < 6; ++k) {
    stress(place[k][0], place[k][1]) += v[k];
    if (place[k][0] != place[k][1]) stress(place[k][1], place[k][0]) += v[k];
  }
}

}  // namespace tribo
