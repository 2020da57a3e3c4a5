// SPDX-License-Identifier: MIT
#include "model/model.hpp"

#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <cmath>

namespace tribo {

bool OutputSpec::wants_strain() const {
  return std::any_of(history.begin(), history.end(), [](const HistoryQuantity& q) {
    const QuantityInfo* info = find_global_quantity(q.name);
    return info && is_strain(*info);
  });
}

bool OutputSpec::wants_deformation() const {
  return wants_strain() || std::any_of(particle_fields.begin(), particle_fields.end(), [](const std::string& name) {
           const ParticleField* field = find_particle_field(name);
           return field && field->needs == ParticleField::Needs::deformation;
         });
}

double Prescribed::at(double t, const Vec3& x, double dt) const {
  switch (style) {
    case Style::constant:
      return t >= time ? value : 0.0;
    case Style::linear:
      return t >= time ? value * (t - time) : 0.0;
    case Style::sine:
      return value * std::sin(time * t);
    case Style::cosine:
      return value * std::cos(time * t);
    case Style::silent:
      return 0.0;
    case Style::function: {
      if (t < time) return 0.0;
      auto at = Variables::at(x, (t - time) / function_time);
      at.dt = dt / function_time;
      return function_scale * function(at);
    }
  }
  return 0.0;
}

}  // namespace tribo
