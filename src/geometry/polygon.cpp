// SPDX-License-Identifier: MIT
#include "geometry/directions.hpp"
#include "geometry/interval.hpp"
#include "geometry/region.hpp"

namespace tribo {
namespace {

using Point = Vec<2>;

double cross(const Point& u, const Point& v) { return u[0] * v[1] - u[1] * v[0]; }

// Squared distance of p from the segment a-b.
double distance2(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * along).squaredNorm();
}

// Whether the closed segments a-b and c-d intersect.
bool intersect(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto apart = [&](int k) {
    return std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k]);
  };
  if (apart(0) || apart(1)) return false;
  const auto one_side = [](double s, double t) { return (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0); };
  return !one_side(cross(b - a, c - a), cross(b - a, d - a)) && !one_side(cross(d - c, a - c), cross(d - c, b - c));
}

class Polygon final : public Region {
 public:
  explicit Polygon(std::vector<Point> corners) : corners_(std::move(corners)) {
    low_ = high_ = corners_.front();
    for (const auto& c : corners_) low_ = low_.cwiseMin(c), high_ = high_.cwiseMax(c);
    slack_ = rounding * std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff());
    if (simple()) area_ = std::abs(signed_area());
  }

  bool contains(const Vec3& x) const override {
    const Point p = x.head<2>();
    if ((p.array() < low_.array() - slack_).any() || (p.array() > high_.array() + slack_).any()) return false;
    bool inside = false;
    for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
      const Point &a = corners_[j], &b = corners_[i];
      const bool level = p[1] >= std::min(a[1], b[1]) - slack_ && p[1] <= std::max(a[1], b[1]) + slack_;
      if (!level) continue;
      if (distance2(p, a, b) <= slack_ * slack_) return true;
      // Half-open in y: a corner belongs to the edge above it only, so that every crossing is counted once.
      if ((a[1] > p[1]) != (b[1] > p[1]) && (cross(b - a, p - a) > 0.0) == (b[1] > a[1])) inside = !inside;
    }
    return inside;
  }
  Bounds bounds() const override { return flat_bounds({low_[0], high_[0]}, {low_[1], high_[1]}); }
  std::optional<double> measure() const override { return area_; }
  bool curved() const override {
    Directions edges;
    for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++)
      edges.add({corners_[i][0] - corners_[j][0], corners_[i][1] - corners_[j][1], 0.0});
    return edges.curved();
  }

 private:
  double signed_area() const {
    double sum = 0.0;
    for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++)
      sum += cross(corners_[j] - corners_[0], corners_[i] - corners_[0]);
    return 0.5 * sum;
  }

  // The area by the even-odd rule equals the shoelace sum if no two non-adjacent edges intersect. This is checked for
  // all pairs of edges up to a size for which it is fast; larger polygons have no exact measure.
  bool simple() const {
    const std::size_t n = corners_.size();
    if (n > 2000) return false;
    const auto at = [&](std::size_t k) -> const Point& { return corners_[k % n]; };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
        if ((j + 1) % n != i && intersect(at(i), at(i + 1), at(j), at(j + 1))) return false;
    return true;
  }

  std::vector<Point> corners_;
  Point low_, high_;
  double slack_ = 0.0;
  std::optional<double> area_;
};

}  // namespace

RegionPtr polygon(std::vector<Vec<2>> corners) {
  for (const auto& c : corners) require_finite("the polygon", c[0], c[1]);
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3)
    throw std::runtime_error("a polygon needs at least 3 corners, not " + std::to_string(corners.size()));
  return std::make_shared<Polygon>(std::move(corners));
}

}  // namespace tribo
