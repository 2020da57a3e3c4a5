// SPDX-License-Identifier: MIT
/// Cracks for tests.
#pragma once

#include "model/model.hpp"

namespace tribo::test {

inline CrackSpec line(const std::vector<Vec3>& points, std::shared_ptr<const ContactLaw> law = nullptr) {
  CrackSpec crack;
  crack.points = points, crack.law = std::move(law);
  for (std::uint32_t k = 1; k < points.size(); ++k) crack.pieces.push_back({k - 1, k, 0});
  return crack;
}

inline CrackSpec line(const Vec3& from, const Vec3& to, int pieces, std::shared_ptr<const ContactLaw> law = nullptr) {
  std::vector<Vec3> points;
  for (int k = 0; k <= pieces; ++k) points.emplace_back(from + (to - from) * k / pieces);
  return line(points, std::move(law));
}

inline CrackSpec sheet(const Vec3& corner, const Vec3& u, const Vec3& v, int n,
                       std::shared_ptr<const ContactLaw> law = nullptr) {
  CrackSpec crack;
  crack.law = std::move(law);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) crack.points.emplace_back(corner + u * i / n + v * j / n);
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const auto& piece :
           {std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}})
        crack.pieces.push_back(piece);
  return crack;
}

}  // namespace tribo::test
