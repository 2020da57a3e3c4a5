// SPDX-License-Identifier: MIT
#include "geometry/ellipse.hpp"
#include "geometry/interval.hpp"
#include "geometry/region.hpp"

#include <numbers>

namespace tribo {
namespace {

class Rectangle final : public Region {
 public:
  Rectangle(Interval x, Interval y) : x_(x), y_(y) {}
  bool contains(const Vec3& p) const override { return x_.contains(p[0]) && y_.contains(p[1]); }
  Bounds bounds() const override { return flat_bounds(x_, y_); }
  std::optional<double> measure() const override { return x_.length() * y_.length(); }

 private:
  Interval x_, y_;
};

class Oval final : public Region {
 public:
  Oval(Interval x, Interval y, Angles angles) : x_(x), y_(y), angles_(angles) {
    if (x.half() <= 0.0 || y.half() <= 0.0) throw std::runtime_error("an oval needs a width and a height");
    limit_ = 1.0 + 2.0 * (x.slack() / x.half() + y.slack() / y.half());
  }
  bool contains(const Vec3& p) const override {
    const double dx = p[0] - x_.middle(), dy = p[1] - y_.middle();
    const double u = dx / x_.half(), v = dy / y_.half();
    return u * u + v * v <= limit_ && angles_.contains(dx, dy);
  }
  Bounds bounds() const override { return flat_bounds(x_, y_); }
  std::optional<double> measure() const override {
    const Ellipse ellipse{x_.half(), y_.half()};
    return angles_.full() ? std::numbers::pi * ellipse.a * ellipse.b : ellipse.sector(angles_.start(), angles_.span());
  }
  bool curved() const override { return true; }

 private:
  Interval x_, y_;
  Angles angles_;
  double limit_;
};

class Arc final : public Region {
 public:
  Arc(Interval x, Interval y, Angles angles, double tolerance)
      : x_(x), y_(y), angles_(angles), ellipse_{x.half(), y.half()}, tolerance_(tolerance) {}
  bool contains(const Vec3& p) const override {
    const double dx = p[0] - x_.middle(), dy = p[1] - y_.middle();
    return angles_.contains(dx, dy) && ellipse_.distance(dx, dy) <= tolerance_ + x_.slack() + y_.slack();
  }
  Bounds bounds() const override {
    return flat_bounds({x_.low() - tolerance_, x_.high() + tolerance_},
                       {y_.low() - tolerance_, y_.high() + tolerance_});
  }
  // The area of a band of constant width about its centre line is length times width if it does not overlap itself. The
  // ends of a part are normal to the line only for a circle.
  std::optional<double> measure() const override {
    if (tolerance_ > ellipse_.sharpest()) return std::nullopt;
    if (angles_.full()) return 2.0 * tolerance_ * ellipse_.perimeter();
    if (ellipse_.a == ellipse_.b) return 2.0 * tolerance_ * angles_.span() * ellipse_.a;
    return std::nullopt;
  }

 private:
  Interval x_, y_;
  Angles angles_;
  Ellipse ellipse_;
  double tolerance_;
};

class Line final : public Region {
 public:
  Line(const Vec3& a, const Vec3& b, double tolerance)
      : a_(a),
        along_(b - a),
        tolerance_(tolerance),
        reach_(tolerance + rounding * (a.cwiseAbs() + b.cwiseAbs()).sum()) {}
  bool contains(const Vec3& p) const override {
    const double length2 = along_.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp((p - a_).dot(along_) / length2, 0.0, 1.0) : 0.0;
    return (p - a_ - s * along_).norm() <= reach_;
  }
  Bounds bounds() const override {
    const Vec3 b = a_ + along_, margin = Vec3::Constant(tolerance_);
    return {a_.cwiseMin(b) - margin, a_.cwiseMax(b) + margin};
  }

 private:
  Vec3 a_, along_;
  double tolerance_, reach_;
};

}  // namespace

RegionPtr rectangle(double xmin, double xmax, double ymin, double ymax) {
  require_finite("the rectangle", xmin, xmax, ymin, ymax);
  return std::make_shared<Rectangle>(Interval(xmin, xmax), Interval(ymin, ymax));
}

RegionPtr oval(double xmin, double xmax, double ymin, double ymax, double start, double end) {
  require_finite("the oval", xmin, xmax, ymin, ymax, start, end);
  return std::make_shared<Oval>(Interval(xmin, xmax), Interval(ymin, ymax), Angles(start, end));
}

RegionPtr line(const Vec3& a, const Vec3& b, double tolerance) {
  require_finite("the line", a[0], a[1], a[2], b[0], b[1], b[2], tolerance);
  if (tolerance < 0.0) throw std::runtime_error("the tolerance of a line must not be negative");
  return std::make_shared<Line>(a, b, tolerance);
}

RegionPtr arc(double xmin, double xmax, double ymin, double ymax, double start, double end, double tolerance) {
  require_finite("the arc", xmin, xmax, ymin, ymax, start, end, tolerance);
  if (tolerance < 0.0) throw std::runtime_error("the tolerance of an arc must not be negative");
  return std::make_shared<Arc>(Interval(xmin, xmax), Interval(ymin, ymax), Angles(start, end), tolerance);
}

}  // namespace tribo
