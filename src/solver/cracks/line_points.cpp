// SPDX-License-Identifier: MIT
#include "solver/cracks/line_points.hpp"

#include <algorithm>

namespace tribo {
namespace {

// Whether the line runs forward from its first to its last point, and is nowhere farther from the segment between them
// than `tolerance`.
bool is_straight(std::span<const Vec3> line, double tolerance) {
  const Vec3 chord = line.back() - line.front();
  const double length = chord.norm();
  if (!(length > 0)) return false;
  const Vec3 along = chord / length;
  double reached = 0.0;
  return std::all_of(line.begin(), line.end(), [&](const Vec3& x) {
    const Vec3 from = x - line.front();
    const double at = from.dot(along), before = reached;
    reached = at;
    return at >= before && (from - at * along).norm() <= tolerance;
  });
}

}  // namespace

std::vector<std::uint32_t> resolved_points(std::span<const Vec3> line, double cell) {
  constexpr double longest = 0.25 * (1 + 1e-9), tolerance = 1e-4;  // cells
  std::vector<std::uint32_t> kept;
  for (std::size_t k = 0; k < line.size();) {
    kept.push_back(static_cast<std::uint32_t>(k));
    std::size_t next = k + 1;
    while (next + 1 < line.size() && (line[next + 1] - line[k]).norm() <= longest * cell) ++next;
    while (next > k + 1 && !is_straight(line.subspan(k, next - k + 1), tolerance * cell)) next = (k + next + 1) / 2;
    k = next;
  }
  return kept;
}

}  // namespace tribo
