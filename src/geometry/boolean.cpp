// SPDX-License-Identifier: MIT
#include "geometry/interval.hpp"
#include "geometry/region.hpp"

#include <Eigen/Geometry>

namespace tribo {
namespace {

bool apart(const Bounds& a, const Bounds& b) {
  return (a.high.array() < b.low.array()).any() || (b.high.array() < a.low.array()).any();
}

class Union final : public Region {
 public:
  explicit Union(std::vector<RegionPtr> parts) : parts_(std::move(parts)) {
    for (const auto& part : parts_) bounds_.push_back(part->bounds());
  }
  bool contains(const Vec3& x) const override {
    return std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part->contains(x); });
  }
  Bounds bounds() const override {
    Bounds all = bounds_.front();
    for (const auto& b : bounds_) all.low = all.low.cwiseMin(b.low), all.high = all.high.cwiseMax(b.high);
    return all;
  }
  // The sum of the parts' measures, if the parts cannot overlap.
  std::optional<double> measure() const override {
    double sum = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        if (!apart(bounds_[i], bounds_[j])) return std::nullopt;
      const auto part = parts_[i]->measure();
      if (!part) return std::nullopt;
      sum += *part;
    }
    return sum;
  }
  bool curved() const override {
    return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->curved(); });
  }

 private:
  std::vector<RegionPtr> parts_;
  std::vector<Bounds> bounds_;
};

class Intersection final : public Region {
 public:
  Intersection(RegionPtr a, RegionPtr b) : a_(std::move(a)), b_(std::move(b)) {}
  bool contains(const Vec3& x) const override { return a_->contains(x) && b_->contains(x); }
  Bounds bounds() const override {
    const Bounds a = a_->bounds(), b = b_->bounds();
    const Vec3 low = a.low.cwiseMax(b.low);
    return {low, a.high.cwiseMin(b.high).cwiseMax(low)};
  }
  bool curved() const override { return a_->curved() || b_->curved(); }

 private:
  RegionPtr a_, b_;
};

class Difference final : public Region {
 public:
  Difference(RegionPtr a, RegionPtr b) : a_(std::move(a)), b_(std::move(b)) {}
  bool contains(const Vec3& x) const override { return a_->contains(x) && !b_->contains(x); }
  Bounds bounds() const override { return a_->bounds(); }
  std::optional<double> measure() const override {
    return apart(a_->bounds(), b_->bounds()) ? a_->measure() : std::nullopt;
  }
  bool curved() const override { return a_->curved() || b_->curved(); }

 private:
  RegionPtr a_, b_;
};

class Moved final : public Region {
 public:
  Moved(RegionPtr part, Mat3 rotation, const Vec3& centre, const Vec3& shift)
      : part_(std::move(part)), rotation_(std::move(rotation)), centre_(centre), target_(centre + shift) {}

  bool contains(const Vec3& x) const override {
    return part_->contains(centre_ + rotation_.transpose() * (x - target_));
  }

  // Each coordinate bound is a sum over the directions of the part; directions that do not contribute may be unbounded.
  Bounds bounds() const override {
    const Bounds b = part_->bounds();
    Bounds out{target_, target_};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double r = rotation_(i, j);
        if (std::abs(r) < 1e-15) continue;
        const double p = r * (b.low[j] - centre_[j]), q = r * (b.high[j] - centre_[j]);
        out.low[i] += std::min(p, q), out.high[i] += std::max(p, q);
      }
    return out;
  }
  std::optional<double> measure() const override { return part_->measure(); }
  bool curved() const override { return part_->curved(); }

 private:
  RegionPtr part_;
  Mat3 rotation_;
  Vec3 centre_, target_;
};

}  // namespace

RegionPtr unite(std::vector<RegionPtr> parts) {
  if (parts.empty()) throw std::runtime_error("a union needs at least one shape");
  return parts.size() == 1 ? parts.front() : std::make_shared<Union>(std::move(parts));
}

RegionPtr intersect(RegionPtr a, RegionPtr b) { return std::make_shared<Intersection>(std::move(a), std::move(b)); }

RegionPtr subtract(RegionPtr a, RegionPtr b) { return std::make_shared<Difference>(std::move(a), std::move(b)); }

RegionPtr move(RegionPtr part, const Vec3& axis, double angle, const Vec3& centre, const Vec3& shift) {
  require_finite("the motion", axis[0], axis[1], axis[2], angle, centre[0], centre[1], centre[2], shift[0], shift[1],
                 shift[2]);
  if (!(axis.norm() > 0.0)) throw std::runtime_error("a rotation needs an axis that is not zero");
  const Mat3 rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  return std::make_shared<Moved>(std::move(part), rotation, centre, shift);
}

}  // namespace tribo
