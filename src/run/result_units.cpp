// SPDX-License-Identifier: MIT
#include "run/result_units.hpp"

#include "materials/material.hpp"
#include "model/block_quantities.hpp"
#include "model/blocks.hpp"
#include "model/output_fields.hpp"
#include "model/quantities.hpp"

#include <sstream>

namespace tribo {
namespace {

std::string energy_unit(const Units& units) {
  const std::string force = units.name(Dimension::force), length = units.name(Dimension::length);
  if (force == "N" && length == "m") return "J";
  if (force.find('/') == std::string::npos) return force + " " + length;
  return units.name(Dimension::mass) + " " + length + "^2/" + units.name(Dimension::time) + "^2";
}

std::string word_in(const Units& units, const std::string& word) {
  const std::string name = word.substr(0, word.find('^')), power = word.substr(name.size());
  if (name == "-") return "";
  if (name == "energy") return energy_unit(units);
  if (name == "velocity") return units.name(Dimension::velocity);
  for (int k = 0; k <= static_cast<int>(Dimension::angle); ++k)
    if (const auto dimension = static_cast<Dimension>(k); dimension_name(dimension) == name)
      return units.name(dimension) + power;
  return word;
}

}  // namespace

std::string unit_in(const Units& units, std::string_view generic) {
  std::istringstream words{std::string(generic)};
  std::string out;
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word_in(units, word);
  return out;
}

std::map<std::string, std::string> units_of_results(const Model& model) {
  std::map<std::string, std::string> out;
  const auto add = [&](std::string_view name, std::string_view generic) {
    if (const std::string unit = unit_in(model.units, generic); !unit.empty()) out[std::string(name)] = unit;
  };
  for (const auto& field : particle_fields()) add(field.name, field.unit);
  add("size", "length"), add("domain", "length");
  for (const auto& material : model.materials) {
    if (!material.law) continue;  // of rigid blocks
    for (const auto& variable : material.law->history())
      if (variable.dimension != Dimension::none) out[variable.name] = model.units.name(variable.dimension);
  }
  for (const auto& q : model.output.history)
    if (const auto* info = find_global_quantity(q.name)) add(q.column, info->unit);
  if (model.blocks) {
    using Of = BlockQuantityInfo::Of;
    add("kinetic_energy", "energy"), add("spin", "1/time"), add("force", "force"), add("moment", "energy");
    add("area", "length^2"), add("gap", "length"), add("opening", "length");
    add("shear", "length"), add("slip", "length"), add("normal_stress", "stress"), add("shear_stress", "stress");
    add("lost_energy", "energy");
    for (const auto& q : model.blocks->histories)
      if (const auto* info = find_block_quantity(q.name, q.group >= 0    ? Of::block
                                                         : q.platen >= 0 ? Of::platen
                                                                         : Of::run))
        add(q.column, info->unit);
  }
  add("kinetic", "energy"), add("momentum_x", "mass velocity");  // of energy.csv
  return out;
}

}  // namespace tribo
