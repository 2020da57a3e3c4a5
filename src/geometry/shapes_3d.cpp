// SPDX-License-Identifier: MIT
#include "geometry/ellipse.hpp"
#include "geometry/interval.hpp"
#include "geometry/region.hpp"

#include <numbers>

namespace tribo {
namespace {

using std::numbers::pi;

// The three sides of a box; that of `axis` comes first if one is given.
std::array<Interval, 3> sides(const Vec3& low, const Vec3& high) {
  return {Interval(low[0], high[0]), Interval(low[1], high[1]), Interval(low[2], high[2])};
}

Bounds bounds_of(const std::array<Interval, 3>& s) {
  return {Vec3(s[0].low(), s[1].low(), s[2].low()), Vec3(s[0].high(), s[1].high(), s[2].high())};
}

class Box final : public Region {
 public:
  explicit Box(std::array<Interval, 3> s) : s_(s) {}
  bool contains(const Vec3& p) const override {
    return s_[0].contains(p[0]) && s_[1].contains(p[1]) && s_[2].contains(p[2]);
  }
  Bounds bounds() const override { return bounds_of(s_); }
  std::optional<double> measure() const override { return s_[0].length() * s_[1].length() * s_[2].length(); }

 private:
  std::array<Interval, 3> s_;
};

class Ellipsoid final : public Region {
 public:
  explicit Ellipsoid(std::array<Interval, 3> s) : s_(s) {
    for (const auto& side : s_) {
      if (side.half() <= 0.0) throw std::runtime_error("a sphere needs an extent in all three directions");
      limit_ += 2.0 * side.slack() / side.half();
    }
  }
  bool contains(const Vec3& p) const override {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const auto& side = s_[static_cast<std::size_t>(k)];
      const double u = (p[k] - side.middle()) / side.half();
      sum += u * u;
    }
    return sum <= limit_;
  }
  Bounds bounds() const override { return bounds_of(s_); }
  std::optional<double> measure() const override { return 4.0 / 3.0 * pi * s_[0].half() * s_[1].half() * s_[2].half(); }
  bool curved() const override { return true; }

 private:
  std::array<Interval, 3> s_;
  double limit_ = 1.0;
};

// Common part of shapes about a coordinate axis: the side along the axis and the two others, in cyclic order.
class AxialShape : public Region {
 public:
  AxialShape(const std::array<Interval, 3>& s, int axis)
      : axis_(axis),
        first_((axis + 1) % 3),
        second_((axis + 2) % 3),
        sides_(s),
        along_(side(axis)),
        u_(side(first_)),
        v_(side(second_)) {}
  bool curved() const override { return true; }

 protected:
  // Coordinates relative to the centre of the box: first and second transverse, then axial.
  Vec3 local(const Vec3& p) const {
    return {p[first_] - u_.middle(), p[second_] - v_.middle(), p[axis_] - along_.middle()};
  }
  // Bounds with the transverse half widths `u` and `v`.
  Bounds bounds_across(double u, double v) const {
    Bounds b = bounds_of(sides_);
    b.low[first_] = u_.middle() - u, b.high[first_] = u_.middle() + u;
    b.low[second_] = v_.middle() - v, b.high[second_] = v_.middle() + v;
    return b;
  }
  double slack() const { return u_.slack() + v_.slack() + along_.slack(); }
  const Interval& side(int k) const { return sides_[static_cast<std::size_t>(k)]; }

  int axis_, first_, second_;
  std::array<Interval, 3> sides_;
  Interval along_, u_, v_;
};

class Cylinder final : public AxialShape {
 public:
  Cylinder(const std::array<Interval, 3>& s, int axis, double taper)
      : AxialShape(s, axis), low_(taper >= 0.0 ? 1.0 : -taper), high_(taper >= 0.0 ? taper : 1.0) {
    if (u_.half() <= 0.0 || v_.half() <= 0.0) throw std::runtime_error("a cylinder needs an extent across its axis");
    slack_ = slack() / std::min(u_.half(), v_.half());
  }
  bool contains(const Vec3& p) const override {
    if (!along_.contains(p[axis_])) return false;
    const Vec3 x = local(p);
    const double s = along_.length() > 0.0 ? std::clamp((p[axis_] - along_.low()) / along_.length(), 0.0, 1.0) : 0.0;
    const double radius = low_ + (high_ - low_) * s + 2.0 * slack_;
    return std::hypot(x[0] / u_.half(), x[1] / v_.half()) <= radius;
  }
  Bounds bounds() const override { return bounds_of(sides_); }
  std::optional<double> measure() const override {
    return pi * u_.half() * v_.half() * along_.length() * (low_ * low_ + low_ * high_ + high_ * high_) / 3.0;
  }

 private:
  double low_, high_;  // radii at the ends relative to the half width of the box
  double slack_ = 0.0;
};

class Torus final : public AxialShape {
 public:
  Torus(const std::array<Interval, 3>& s, int axis, double tube)
      : AxialShape(s, axis), ring_{u_.half(), v_.half()}, tube_(tube > 0.0 ? tube : along_.half()) {
    if (ring_.a <= 0.0 || ring_.b <= 0.0 || along_.half() <= 0.0)
      throw std::runtime_error("a torus needs an extent in all three directions");
    limit_ = 1.0 + 2.0 * slack() / std::min(tube_, along_.half());
  }
  bool contains(const Vec3& p) const override {
    if (!along_.contains(p[axis_])) return false;
    const Vec3 x = local(p);
    return std::hypot(ring_.distance(x[0], x[1]) / tube_, x[2] / along_.half()) <= limit_;
  }
  Bounds bounds() const override { return bounds_across(ring_.a + tube_, ring_.b + tube_); }
  // Pappus' theorem: length of the centre line times area of the cross-section, if the torus does not overlap itself.
  std::optional<double> measure() const override {
    if (tube_ > ring_.sharpest()) return std::nullopt;
    return ring_.perimeter() * pi * tube_ * along_.half();
  }

 private:
  Ellipse ring_;
  double tube_;
  double limit_ = 1.0;
};

class Shell final : public AxialShape {
 public:
  Shell(const std::array<Interval, 3>& s, int axis, double radius, double thickness)
      : AxialShape(s, axis), wall_(std::max(0.0, radius - 0.5 * thickness), radius + 0.5 * thickness) {}
  bool contains(const Vec3& p) const override {
    if (!along_.contains(p[axis_])) return false;
    const Vec3 x = local(p);
    const double r = std::hypot(x[0], x[1]);
    return r >= wall_.low() - slack() && r <= wall_.high() + slack();
  }
  Bounds bounds() const override { return bounds_across(wall_.high(), wall_.high()); }
  std::optional<double> measure() const override {
    return pi * (wall_.high() * wall_.high() - wall_.low() * wall_.low()) * along_.length();
  }

 private:
  Interval wall_;
};

std::array<Interval, 3> checked(const char* what, const Vec3& low, const Vec3& high, int axis = 0) {
  require_finite(what, low[0], low[1], low[2], high[0], high[1], high[2]);
  if (axis < 0 || axis > 2) throw std::runtime_error(std::string(what) + " needs an axis x, y or z");
  return sides(low, high);
}

}  // namespace

RegionPtr box(const Vec3& low, const Vec3& high) { return std::make_shared<Box>(checked("the box", low, high)); }

RegionPtr ellipsoid(const Vec3& low, const Vec3& high) {
  return std::make_shared<Ellipsoid>(checked("the sphere", low, high));
}

RegionPtr cylinder(const Vec3& low, const Vec3& high, int axis, double taper) {
  const auto s = checked("the cylinder", low, high, axis);
  if (!(std::abs(taper) <= 1.0)) throw std::runtime_error("the radius ratio of a cylinder must be in [-1, 1]");
  return std::make_shared<Cylinder>(s, axis, taper);
}

RegionPtr torus(const Vec3& low, const Vec3& high, int axis, double tube) {
  const auto s = checked("the torus", low, high, axis);
  require_finite("the torus", tube);
  if (tube < 0.0) throw std::runtime_error("the radius of a torus must not be negative");
  return std::make_shared<Torus>(s, axis, tube);
}

RegionPtr shell(const Vec3& low, const Vec3& high, int axis, double radius, double thickness) {
  const auto s = checked("the shell", low, high, axis);
  require_finite("the shell", radius, thickness);
  if (radius <= 0.0 || thickness <= 0.0) throw std::runtime_error("radius and thickness of a shell must be positive");
  return std::make_shared<Shell>(s, axis, radius, thickness);
}

}  // namespace tribo
