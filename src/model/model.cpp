// SPDX-License-Identifier: MIT
#include "model/model.hpp"

#include "model/output_fields.hpp"
#include "model/quantities.hpp"

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

}  // namespace tribo
