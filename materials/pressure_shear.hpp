/// What plastic laws share whose yield depends on mean stress and von Mises stress only: the return leaves the
/// direction of the deviator.
#pragma once

#include "materials/elastic.hpp"

#include <cmath>

namespace tribo {

/// Mean stress (tension positive) and von Mises stress q = sqrt(3/2 s:s) [stress].
struct PressureShear {
  double p = 0, q = 0;
};

inline PressureShear pressure_shear(const Mat3& stress) {
  const double p = stress.trace() / 3;
  return {p, std::sqrt(1.5 * (stress - p * Mat3::Identity()).squaredNorm())};
}

/// The stress after a step: elastic trial (Jaumann rate), then flow(trial) -> PressureShear, where it returns to.
template <class Flow>
Mat3 plastic_step(const Elasticity& elastic, const Motion& motion, const Mat3& old, Flow&& flow) {
  const Mat3 trial = elastic_trial(elastic, motion, old);
  const PressureShear at = pressure_shear(trial), to = flow(at);
  if (to.p == at.p && to.q == at.q) return trial;
  const double share = at.q > 0 ? to.q / at.q : 0.0;
  return to.p * Mat3::Identity() + share * (trial - at.p * Mat3::Identity());
}

}  // namespace tribo
