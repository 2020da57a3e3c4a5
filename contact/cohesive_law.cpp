// SPDX-License-Identifier: MIT
#include "contact/cohesive_law.hpp"

#include "contact/joint_parts.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

/// Displacements of a zone: opening, which is not negative, and sliding.
struct CohesiveLaw::Jump {
  std::array<double, 2> d;
  explicit Jump(const Joint& joint) : d{std::max(joint.opening, 0.0), joint.shear.norm()} {}
  Jump(const Jump& a, const Jump& b, double t) : d{a.d[0] + t * (b.d[0] - a.d[0]), a.d[1] + t * (b.d[1] - a.d[1])} {}
};

Joint CohesiveLaw::start(const JointSite& site) const {
  Joint j;
  set_area(j, site, 0.0);
  j.gap = site.gap;
  j.kn = std::max(curves_[0]->slope(), closed_), j.ks = curves_[1]->slope();
  // Faces that are apart are not bonded.
  if (site.gap > 0) {
    j.opening = site.gap, j.away = true;
    j.state = broken, j.damage = {1.0, 1.0}, j.torn = j.shear_weak = true;
  }
  return j;
}

// The criterion of failure of separate modes; at least 1 for a zone that has failed.
double CohesiveLaw::failure(const std::array<double, 2>& largest) const {
  double sum = 0.0, worst = 0.0;
  for (std::size_t mode = 0; mode < 2; ++mode) {
    const TractionCurve& curve = *curves_[mode];
    if (std::isinf(curve.critical())) continue;
    worst = std::max(worst, largest[mode] / curve.critical());
    if (exponent_ > 0) sum += std::pow(std::min(curve.area(largest[mode]) / curve.toughness(), 1.0), exponent_);
  }
  return exponent_ > 0 ? std::max(sum, worst >= 1 ? 1.0 : 0.0) : worst;
}

void CohesiveLaw::grow_separately(Joint& j, const Jump& from, const Jump& to) const {
  const std::array<double, 2> before = j.largest;
  const auto largest_at = [&](double t) {
    const Jump at(from, to, t);
    return std::array{std::max(before[0], at.d[0]), std::max(before[1], at.d[1])};
  };
  j.largest = largest_at(1.0);
  if (j.largest == before) return;
  if (failure(j.largest) >= 1) {
    // The energy is that at the moment of failure within the step, not that of the end of the step.
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 60; ++k) (failure(largest_at(0.5 * (low + high))) >= 1 ? high : low) = 0.5 * (low + high);
    const auto last = largest_at(high);
    const Jump at(from, to, high);
    for (std::size_t mode = 0; mode < 2; ++mode) {
      const TractionCurve& curve = *curves_[mode];
      // what the mode still stores is lost, too
      const double stored = 0.5 * curve.secant(last[mode]) * at.d[mode] * at.d[mode];
      if (last[mode] >= curve.critical())
        j.decohesion[mode] = curve.toughness();
      else
        j.decohesion[mode] = stored + (std::isinf(curve.critical()) ? 0.0 : curve.dissipated(last[mode]));
    }
    j.damage = {1.0, 1.0};
    return;
  }
  for (std::size_t mode = 0; mode < 2; ++mode) {
    j.damage[mode] = curves_[mode]->damage(j.largest[mode]);
    j.decohesion[mode] = std::isinf(curves_[mode]->critical()) ? 0.0 : curves_[mode]->dissipated(j.largest[mode]);
  }
}

void CohesiveLaw::grow_together(Joint& j, const Jump& to) const {
  const auto excess = [&](double damage) {
    double sum = -1.0;
    for (std::size_t mode = 0; mode < 2; ++mode) {
      const double ratio = to.d[mode] > 0 ? to.d[mode] / curves_[mode]->at_damage(damage) : 0.0;
      sum += ratio * ratio;
    }
    return sum;
  };
  const double before = j.damage[0];
  if (!(excess(before) > 0)) return;
  double after = 1.0;
  if (excess(1.0) < 0) {
    double low = before;
    for (int k = 0; k < 60; ++k) (excess(0.5 * (low + after)) > 0 ? low : after) = 0.5 * (low + after);
  }
  // d_n = d_I(D) cos, d_t = d_II(D) sin of an angle of mode mixity: each mode dissipates its share of what its curve
  // does. `largest` keeps the squares of both at the end of the last growth.
  const double ratio = to.d[0] / curves_[0]->at_damage(after), other = to.d[1] / curves_[1]->at_damage(after);
  const double now = ratio * ratio / (ratio * ratio + other * other);
  const double was = before > 0 ? j.largest[0] : now;
  for (std::size_t mode = 0; mode < 2; ++mode) {
    const double share = mode == 0 ? 0.5 * (was + now) : 1 - 0.5 * (was + now);
    const TractionCurve& curve = *curves_[mode];
    if (!(share > 0) || std::isinf(curve.critical())) continue;
    const auto at = [&](double damage) { return curve.dissipated(curve.at_damage(damage)); };
    j.decohesion[mode] += share * ((after < 1 ? at(after) : curve.toughness()) - at(before));
  }
  j.largest = {now, 1 - now};
  j.damage = {after, after};
}

void CohesiveLaw::update(std::span<Joint> joints, std::span<const JointIncrement> increments,
                         std::vector<JointEvent>& events) const {
  for (std::size_t k = 0; k < joints.size(); ++k) {
    Joint& j = joints[k];
    const Joint before = j;
    j.opening += increments[k].normal, j.shear += increments[k].shear, j.gap = increments[k].gap;
    const Jump jump(j);
    if (j.state != broken) {
      if (one_damage_)
        grow_together(j, jump);
      else
        grow_separately(j, Jump(before), jump);
      const double worst = std::max(j.damage[0], j.damage[1]);
      j.state = worst >= 1 && std::min(j.damage[0], j.damage[1]) >= 1 ? broken : worst > 0 ? softening : intact;
    }
    const double kn = (1 - j.damage[0]) * curves_[0]->slope(), ks = (1 - j.damage[1]) * curves_[1]->slope();
    j.Fn = j.area * (j.opening < 0 ? closed_ : kn) * j.opening;
    j.Fs = (-j.area * ks) * j.shear;
    j.strain = 0.5 * (j.Fn * j.opening - j.Fs.dot(j.shear));
    j.elongation = std::max(j.elongation, jump.d[0]);
    if (before.state == broken) j.slip += increments[k].shear.norm();
    j.torn = j.shear_weak = j.state == broken;
    j.away = j.torn && j.opening >= 0;
    add_work(j, before, increments[k]);
    if (j.state == broken && before.state != broken) {
      const auto ratio = [&](std::size_t mode) {
        const double most = curves_[mode]->toughness();
        return most > 0 && std::isfinite(most) ? j.decohesion[mode] / most : 0.0;
      };
      const std::size_t mode = ratio(0) >= ratio(1) ? 0 : 1;
      const double force = mode == 0 ? before.Fn : before.Fs.norm();
      events.push_back({JointEvent::Kind::bond_break, k, static_cast<int>(mode) + 1, false, false, false,
                        curves_[mode]->peak(), j.area * (j.decohesion[0] + j.decohesion[1]), force});
    }
  }
}

std::string CohesiveLaw::state_text(const Joint& j) const {
  return j.state == broken ? "broken" : j.state == softening ? "softening" : "intact";
}

std::vector<double> CohesiveLaw::own_values(const Joint& j) const {
  return {j.damage[0], j.damage[1], j.decohesion[0], j.decohesion[1]};
}

double CohesiveLaw::stiffness() const { return std::max({curves_[0]->slope(), curves_[1]->slope(), closed_}); }

}  // namespace tribo
