// SPDX-License-Identifier: MIT
/// Common parts of plastic laws whose yield condition depends on mean stress and von Mises stress only. The return
/// does not change the direction of the deviator.
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

/// Further quantities on which a return may depend.
struct ReturnStep {
  double dt;                                  ///< [time]
  double J;                                   ///< volume ratio at t + dt
  double temperature, reference_temperature;  ///< at t, and that of the given properties [temperature]
};

/// Batch implementation for a law with `Elasticity elastic` and `PressureShear returned(const PressureShear& trial,
/// const ReturnStep&, State&) const`, which gives the returned stress and updates the state. The trial stresses
/// (Jaumann rate) of a batch are computed together, then the points are returned one by one.
template <class Law>
class PressureShearMaterial final : public PointwiseMaterial<Law> {
 public:
  using PointwiseMaterial<Law>::PointwiseMaterial;
  void update(const MaterialPoints<2>& points) const override { advance<2>(points); }
  void update(const MaterialPoints<3>& points) const override { advance<3>(points); }

 private:
  std::shared_ptr<const Material> again(Law law) const override {
    return std::make_shared<PressureShearMaterial>(std::move(law));
  }

  template <int Dim>
  void advance(const MaterialPoints<Dim>& points) const {
    if (points.plane_stress) return PointwiseMaterial<Law>::update(points);
    const Law& law = this->law();
    elastic_step<Dim>(points, law.elastic);
    const auto& s = points.stress;
    for (int i = 0; i < points.count; ++i) {
      const double p = (s[0][i] + s[1][i] + s[2][i]) / 3;
      double square = 0;  // s:s of the deviator
      for (std::size_t k = 0; k < s.size(); ++k) {
        const double part = k < 3 ? s[k][i] - p : s[k][i];
        square += k < 3 ? part * part : 2 * part * part;
      }
      const PressureShear trial{p, std::sqrt(1.5 * square)};
      typename Law::State state = this->load(points, i);
      const double reference = points.reference_temperature;
      const PressureShear to = law.returned(trial,
                                            {points.dt, load_full<Dim>(points.F, i).determinant(),
                                             points.temperature ? points.temperature[i] : reference, reference},
                                            state);
      if (to.p == trial.p && to.q == trial.q) continue;
      const double share = trial.q > 0 ? to.q / trial.q : 0.0;
      for (std::size_t k = 0; k < s.size(); ++k) s[k][i] = k < 3 ? to.p + share * (s[k][i] - p) : share * s[k][i];
      this->store(state, points, i);
    }
  }
};

/// Implementation for one point.
template <class Law>
Mat3 plastic_step(const Law& law, const Motion& motion, const Mat3& old, typename Law::State& state) {
  const Mat3 trial = elastic_trial(law.elastic, motion, old);
  const PressureShear at = pressure_shear(trial),
                      to = law.returned(
                          at, {motion.dt, motion.F.determinant(), motion.temperature, motion.reference_temperature},
                          state);
  if (to.p == at.p && to.q == at.q) return trial;
  const double share = at.q > 0 ? to.q / at.q : 0.0;
  return to.p * Mat3::Identity() + share * (trial - at.p * Mat3::Identity());
}

}  // namespace tribo
