// SPDX-License-Identifier: MIT
#include "contact/traction_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tribo {

// The secant never grows, so its root is bracketed.
double TractionCurve::at_damage(double damage) const {
  double low = elastic_limit(), high = critical();
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (this->damage(middle) < damage ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

namespace {

class Linear final : public TractionCurve {
 public:
  explicit Linear(double slope) : slope_(slope) {}
  double traction(double d) const override { return slope_ * d; }
  double area(double d) const override { return 0.5 * slope_ * d * d; }
  double at_damage(double) const override { return critical(); }
  double slope() const override { return slope_; }
  double elastic_limit() const override { return critical(); }
  double critical() const override { return std::numeric_limits<double>::infinity(); }
  double peak() const override { return critical(); }

 private:
  double slope_;
};

class Piecewise final : public TractionCurve {
 public:
  Piecewise(double d1, double T1, double d2, double T2, double critical) : d_{0, d1, d2, critical}, T_{0, T1, T2, 0} {
    for (std::size_t k = 1; k < d_.size(); ++k)
      area_[k] = area_[k - 1] + 0.5 * (T_[k - 1] + T_[k]) * (d_[k] - d_[k - 1]);
  }
  double traction(double d) const override {
    const std::size_t k = piece(d);
    return k == 0 ? 0.0 : on(k, d);
  }
  double area(double d) const override {
    const std::size_t k = piece(d);
    return k == 0 ? area_.back() : area_[k - 1] + 0.5 * (T_[k - 1] + on(k, d)) * (d - d_[k - 1]);
  }
  double at_damage(double damage) const override {
    // on the line from (a, A) to (b, B): A + (B - A)(d - a)/(b - a) = (1 - damage) k d
    const double secant = (1 - damage) * slope();
    for (std::size_t k = 2; k < d_.size(); ++k) {
      if (T_[k] > secant * d_[k] || !(d_[k] > d_[k - 1])) continue;
      const double fall = (T_[k - 1] - T_[k]) / (d_[k] - d_[k - 1]);
      return std::clamp((T_[k - 1] + fall * d_[k - 1]) / (secant + fall), d_[k - 1], d_[k]);
    }
    return critical();
  }
  double slope() const override { return T_[1] / d_[1]; }
  double elastic_limit() const override { return d_[1]; }
  double critical() const override { return d_.back(); }
  double peak() const override { return std::max(T_[1], T_[2]); }

 private:
  // Number of the point at the end of the piece that holds d; 0: beyond the last.
  std::size_t piece(double d) const {
    for (std::size_t k = 1; k < d_.size(); ++k)
      if (d < d_[k] || (k == 1 && d == d_[1])) return k;
    return 0;
  }
  double on(std::size_t k, double d) const {
    return T_[k - 1] + (T_[k] - T_[k - 1]) * (d - d_[k - 1]) / (d_[k] - d_[k - 1]);
  }
  std::array<double, 4> d_, T_, area_{};
};

class Cubic final : public TractionCurve {
 public:
  Cubic(double peak, double critical) : peak_(peak), critical_(critical) {}
  double traction(double d) const override {
    const double x = std::min(d / critical_, 1.0);
    return slope() * critical_ * x * (1 - x) * (1 - x);
  }
  double area(double d) const override {
    const double x = std::min(d / critical_, 1.0);
    return slope() * critical_ * critical_ * x * x * (0.5 - x * (2.0 / 3 - 0.25 * x));
  }
  double at_damage(double damage) const override { return critical_ * (1 - std::sqrt(1 - damage)); }
  double slope() const override { return 6.75 * peak_ / critical_; }
  double elastic_limit() const override { return 0.0; }
  double critical() const override { return critical_; }
  double peak() const override { return peak_; }

 private:
  double peak_, critical_;
};

class Exponential final : public TractionCurve {
 public:
  Exponential(double d1, double peak, double critical, double alpha)
      : first_(d1), peak_(peak), critical_(critical), alpha_(alpha) {}
  double traction(double d) const override {
    if (d <= first_) return slope() * d;
    if (d >= critical_) return 0.0;
    return peak_ * (std::expm1(alpha_ * (1 - x(d))) / std::expm1(alpha_));
  }
  double area(double d) const override {
    if (d <= first_) return 0.5 * slope() * d * d;
    const double x = d < critical_ ? this->x(d) : 1.0, end = std::exp(-alpha_);
    return 0.5 * peak_ * first_ +
           peak_ * (critical_ - first_) * (-std::expm1(-alpha_ * x) / alpha_ - end * x) / (1 - end);
  }
  double slope() const override { return peak_ / first_; }
  double elastic_limit() const override { return first_; }
  double critical() const override { return critical_; }
  double peak() const override { return peak_; }

 private:
  double x(double d) const { return (d - first_) / (critical_ - first_); }
  double first_, peak_, critical_, alpha_;
};

}  // namespace

SharedCurve linear_curve(double slope) { return std::make_shared<Linear>(slope); }
SharedCurve piecewise_curve(double d1, double T1, double d2, double T2, double critical) {
  return std::make_shared<Piecewise>(d1, T1, d2, T2, critical);
}
SharedCurve cubic_curve(double peak, double critical) { return std::make_shared<Cubic>(peak, critical); }
SharedCurve exponential_curve(double d1, double peak, double critical, double alpha) {
  return std::make_shared<Exponential>(d1, peak, critical, alpha);
}

}  // namespace tribo
