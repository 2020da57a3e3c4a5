// SPDX-License-Identifier: MIT
#include "view/camera.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace tribo {

Camera camera(const std::string& view) {
  if (view == "xy") return {};
  if (view == "xz") return {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY(), "x", "z"};
  if (view == "yz") return {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX(), "y", "z"};
  const bool z_up = view == "iso-z";
  if (view != "iso" && !z_up)
    throw UsageError("there is no view '" + view + "'" + did_you_mean(view, {"xy", "xz", "yz", "iso", "iso-z"}) +
                     "; valid: xy, xz, yz, iso, iso-z");
  Camera out;
  const Vec3 vertical = z_up ? Vec3::UnitZ() : Vec3::UnitY();
  out.eye = (z_up ? Vec3(0.55, -0.75, 0.45) : Vec3(0.55, 0.45, 0.75)).normalized();
  out.right = vertical.cross(out.eye).normalized();
  out.up = out.eye.cross(out.right);
  out.right_name.clear(), out.up_name.clear();
  return out;
}

double spacing_of(const std::vector<std::array<double, 3>>& positions) {
  if (positions.size() < 2) return 0.0;
  std::array<double, 3> low = positions[0], high = positions[0];
  for (const auto& x : positions)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  // Cells with about two particles each if the particles filled the box evenly
  int dimensions = 0;
  double content = 1.0;
  for (std::size_t d = 0; d < 3; ++d)
    if (high[d] > low[d]) ++dimensions, content *= high[d] - low[d];
  if (dimensions == 0) return 0.0;
  double edge = std::pow(2 * content / static_cast<double>(positions.size()), 1.0 / dimensions);
  using Cell = std::array<std::int64_t, 3>;
  const auto cell = [&](const std::array<double, 3>& x) {
    Cell c{};
    for (std::size_t d = 0; d < 3; ++d) c[d] = static_cast<std::int64_t>(std::floor((x[d] - low[d]) / edge));
    return c;
  };
  const auto key = [](const Cell& c) { return (c[0] * 73856093) ^ (c[1] * 19349663) ^ (c[2] * 83492791); };
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < positions.size(); ++i) cells[key(cell(positions[i]))].push_back(i);
  std::vector<double> nearest;
  const std::size_t stride = std::max<std::size_t>(1, positions.size() / 2000);
  for (std::size_t i = 0; i < positions.size(); i += stride) {
    double best = std::numeric_limits<double>::infinity();
    const Cell at = cell(positions[i]);
    for (std::int64_t a = -1; a <= 1; ++a)
      for (std::int64_t b = -1; b <= 1; ++b)
        for (std::int64_t c = -1; c <= 1; ++c) {
          const auto found = cells.find(key({at[0] + a, at[1] + b, at[2] + c}));
          if (found == cells.end()) continue;
          for (const std::size_t j : found->second) {
            double square = 0.0;
            for (std::size_t d = 0; d < 3; ++d)
              square += (positions[i][d] - positions[j][d]) * (positions[i][d] - positions[j][d]);
            if (j != i && square > 0) best = std::min(best, square);
          }
        }
    if (std::isfinite(best)) nearest.push_back(std::sqrt(best));
  }
  if (nearest.empty()) return edge;
  // Particles of compressed bodies are closer to each other than at the start
  const auto k = static_cast<std::size_t>(0.8 * static_cast<double>(nearest.size()));
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(k), nearest.end());
  return nearest[k];
}

}  // namespace tribo
