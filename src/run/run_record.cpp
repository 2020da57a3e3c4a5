// SPDX-License-Identifier: MIT
#include "run/run_record.hpp"

#include "materials/material.hpp"
#include "run/result_units.hpp"

namespace tribo {

std::map<std::string, std::string> facts_of(const Model& model, const SteppedModel& stepped,
                                            const std::string& changed) {
  std::map<std::string, std::string> out = unit_facts(model);
  out["title"] = model.title;
  if (!changed.empty()) out["changed on resumption"] = changed;
  out.merge(stepped.facts());
  return out;
}

RecordedLegend legend_of(const Model& model, const SteppedModel& stepped) {
  RecordedLegend out;
  out.units = units_of_results(model);
  for (const auto& m : model.materials) {
    out.materials.push_back(m.name);
    if (m.law && m.law->rigid()) out.rigid_materials.push_back(m.name);
  }
  out.bodies = stepped.bodies();
  if (model.blocks)
    for (const auto& group : model.blocks->groups) out.block_groups.push_back(group.name);
  return out;
}

}  // namespace tribo
