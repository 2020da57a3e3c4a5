// SPDX-License-Identifier: MIT
#include "solver/cracks/line_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo {
namespace {

constexpr double longest = 0.25, tolerance = 1e-3;  // cells

// The number of a point at which a part of a line is divided, in order that its parts are straight and short; 0: it
// need not be divided.
std::size_t divider(std::span<const Vec3> line, double cell) {
  if (line.size() < 3) return 0;
  const Vec3 chord = line.back() - line.front();
  const double length = chord.norm();
  const Vec3 along = length > 0 ? Vec3(chord / length) : Vec3(Vec3::UnitX());
  // Equal segments: an odd number of them has no middle.
  const double segments = std::max(1.0, std::ceil(length / (longest * cell) - 1e-9));
  const double wanted = std::ceil(0.5 * segments) / segments * length;
  std::size_t farthest = 0, nearest = 0;
  double distance = 0.0, from_wanted = length, reached = 0.0;
  bool forward = length > 0;
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    const Vec3 from = line[k] - line.front();
    const double at = from.dot(along), beside = (from - at * along).norm();
    forward = forward && at >= reached && at <= length;
    reached = at;
    if (beside > distance) distance = beside, farthest = k;
    if (std::abs(at - wanted) < from_wanted) from_wanted = std::abs(at - wanted), nearest = k;
  }
  if (distance > tolerance * cell) return farthest;
  if (!forward) return line.size() / 2;
  return segments > 1 ? nearest : 0;
}

}  // namespace

std::vector<std::uint32_t> resolved_points(std::span<const Vec3> line, double cell) {
  std::vector<std::uint32_t> kept;
  if (line.empty()) return kept;
  std::vector<std::pair<std::size_t, std::size_t>> parts{{0, line.size() - 1}};  // the next one last
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    if (const std::size_t at = divider(line.subspan(first, last - first + 1), cell); at > 0) {
      parts.emplace_back(first + at, last);
      parts.emplace_back(first, first + at);
    } else {
      kept.push_back(static_cast<std::uint32_t>(first));
    }
  }
  if (line.size() > 1) kept.push_back(static_cast<std::uint32_t>(line.size() - 1));
  return kept;
}

}  // namespace tribo
