// SPDX-License-Identifier: MIT
#include "base/text.hpp"
#include "geometry/directions.hpp"
#include "geometry/gmsh.hpp"
#include "geometry/interval.hpp"
#include "geometry/region.hpp"

#include <algorithm>
#include <map>

namespace tribo {
namespace {

using PlanePoint = Vec<2>;
using Edge = std::array<PlanePoint, 2>;

// What edges enclose by the even-odd rule. The edges are sorted into strips of y, so that few are looked at for a
// point.
class Outline final : public Region {
 public:
  Outline(std::vector<Edge> edges, std::optional<double> area) : edges_(std::move(edges)), area_(area) {
    low_ = high_ = edges_.front()[0];
    for (const auto& e : edges_)
      for (const auto& c : e) low_ = low_.cwiseMin(c), high_ = high_.cwiseMax(c);
    slack_ = rounding * std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff());
    strips_.resize(std::min<std::size_t>(edges_.size(), 10'000));
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const auto [a, b] = std::minmax(edges_[k][0][1], edges_[k][1][1]);
      for (std::size_t s = strip(a - slack_); s <= strip(b + slack_); ++s)
        strips_[s].push_back(static_cast<std::uint32_t>(k));
    }
  }

  bool contains(const Vec3& x) const override {
    const PlanePoint p = x.head<2>();
    if ((p.array() < low_.array() - slack_).any() || (p.array() > high_.array() + slack_).any()) return false;
    bool inside = false;
    for (const auto k : strips_[strip(p[1])]) {
      const auto& [a, b] = edges_[k];
      if (distance2(p, a, b) <= slack_ * slack_) return true;
      // Half-open in y, as for polygons: a corner belongs to the edge above it only.
      const PlanePoint along = b - a, from = p - a;
      if ((a[1] > p[1]) != (b[1] > p[1]) && (along[0] * from[1] - along[1] * from[0] > 0.0) == (b[1] > a[1]))
        inside = !inside;
    }
    return inside;
  }
  Bounds bounds() const override { return flat_bounds({low_[0], high_[0]}, {low_[1], high_[1]}); }
  std::optional<double> measure() const override { return area_; }
  bool curved() const override {
    Directions directions;
    for (const auto& [a, b] : edges_) directions.add({b[0] - a[0], b[1] - a[1], 0.0});
    return directions.curved();
  }

 private:
  static double distance2(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
    const PlanePoint along = b - a;
    const double length2 = along.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (p - a - s * along).squaredNorm();
  }
  std::size_t strip(double y) const {
    const double height = high_[1] - low_[1], count = static_cast<double>(strips_.size());
    const double at = height > 0.0 ? (y - low_[1]) / height * count : 0.0;
    return static_cast<std::size_t>(std::clamp(at, 0.0, count - 1));
  }

  std::vector<Edge> edges_;
  std::optional<double> area_;
  PlanePoint low_, high_;
  double slack_ = 0.0;
  std::vector<std::vector<std::uint32_t>> strips_;
};

std::string place_text(const PlanePoint& x) { return format("(%g, %g)", x[0], x[1]); }

// Corners of edges of one mesh are the same numbers.
void check_outline(const std::vector<Edge>& edges) {
  std::map<std::pair<double, double>, int> uses;
  for (const auto& e : edges)
    for (const auto& c : e) {
      require_finite("the outline", c[0], c[1]);
      ++uses[{c[0], c[1]}];
    }
  for (const auto& [x, count] : uses)
    if (count % 2 != 0)
      throw std::runtime_error("the outline is not closed: " + counted(count, "edge") + " " +
                               (count == 1 ? "ends" : "end") + " at " + place_text({x.first, x.second}));
}

}  // namespace

RegionPtr outline(std::vector<std::array<Vec<2>, 2>> edges, std::optional<double> area) {
  if (edges.size() < 3) throw std::runtime_error("an outline needs at least 3 edges");
  check_outline(edges);
  return std::make_shared<Outline>(std::move(edges), area);
}

RegionPtr outline_body(const std::string& path, const std::string& group, double scale, const Vec3& shift) {
  GmshOutline found = gmsh_outline(path, group);
  for (auto& edge : found.edges)
    for (auto& x : edge) x = scale * x + shift.head<2>();
  if (found.area) *found.area *= scale * scale;
  try {
    return outline(std::move(found.edges), found.area);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace tribo
