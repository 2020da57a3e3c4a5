// SPDX-License-Identifier: MIT
#include "run/layer_list.hpp"

#include <nlohmann/json.hpp>

namespace tribo {

void Layer::line(const Vec3& a, const Vec3& b) {
  const auto k = static_cast<std::uint32_t>(points.size());
  points.push_back(a), points.push_back(b), lines.push_back({k, k + 1});
}

void Layer::arrow(const Vec3& a, const Vec3& b) {
  line(a, b);
  const Vec3 along = b - a, other = std::abs(along[2]) < 0.9 * along.norm() ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 side = along.cross(other).normalized() * along.norm();
  for (const double s : {-0.15, 0.15}) line(b, b - 0.3 * along + s * side);
}

void Layer::box(const Bounds& bounds) {
  const bool flat = !(bounds.high[2] > bounds.low[2]);
  const auto corner = [&](int k) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = (k >> d & 1) != 0 ? bounds.high[d] : bounds.low[d];
    return x;
  };
  for (int k = 0; k < (flat ? 4 : 8); ++k)
    for (int d = 0; d < (flat ? 2 : 3); ++d)
      if ((k >> d & 1) == 0) line(corner(k), corner(k | 1 << d));
}

std::string json_of(const std::vector<Layer>& layers) {
  using Json = nlohmann::json;
  Json out = Json::array();
  for (const Layer& layer : layers) {
    if (layer.points.empty()) continue;
    Json points = Json::array();
    for (const Vec3& x : layer.points) points.push_back({x[0], x[1], x[2]});
    out.push_back({{"name", layer.name},
                   {"note", layer.note},
                   {"colour", layer.colour},
                   {"width", layer.width},
                   {"opacity", layer.opacity},
                   {"shown", layer.shown},
                   {"points", std::move(points)},
                   {"lines", layer.lines},
                   {"polygons", layer.polygons}});
  }
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tribo
