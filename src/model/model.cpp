// SPDX-License-Identifier: MIT
#include "model/model.hpp"

#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

double TemperatureRamp::done(double time) const {
  if (time <= start) return 0.0;
  const bool over = !(time < start + duration);
  const double x = over ? 1.0 : (time - start) / duration;
  if (lifetimes > 0) return 1 - std::exp(-std::pow(lifetimes * x, stretch));
  // from 0.0025 to 0.9975: the rest is added at both ends
  return sigmoidal && !over ? 1 / (1 + std::exp(-12 * (x - 0.5))) : x;
}

namespace {

bool has_history(const OutputSpec& output, bool (*of_kind)(const QuantityInfo&)) {
  return std::any_of(output.history.begin(), output.history.end(), [&](const HistoryQuantity& q) {
    const QuantityInfo* info = find_global_quantity(q.name);
    return info && of_kind(*info);
  });
}

}  // namespace

bool Model::damps_particles() const {
  const auto damped = [](const MaterialSpec& m) { return m.particle_damping.has_value(); };
  return damping.particle || damping.particle_gain || std::any_of(materials.begin(), materials.end(), damped);
}

bool Model::seeks_equilibrium() const {
  return damping.grid || damping.particle || damping.grid_gain || damping.particle_gain || !stages.empty();
}

bool OutputSpec::wants_strain() const { return has_history(*this, is_strain); }
bool OutputSpec::wants_elastic_strain() const { return has_history(*this, is_elastic_strain); }

bool OutputSpec::wants_deformation() const {
  return has_history(*this, is_deformation) ||
         std::any_of(particle_fields.begin(), particle_fields.end(), [](const std::string& name) {
           const ParticleField* field = find_particle_field(name);
           return field && field->needs == ParticleField::Needs::deformation;
         });
}

}  // namespace tribo
