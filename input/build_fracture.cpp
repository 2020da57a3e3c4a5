// SPDX-License-Identifier: MIT
/// Fracture: quantities computed at crack tips, and criteria for their growth.

#include "input/builder.hpp"
#include "input/common_properties.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tribo {

// Reads a property of a material that belongs to fracture.
void Builder::fracture_property(const Statement& s, MaterialSpec& spec) {
  Toughness& t = spec.toughness;
  const auto above_zero = [&](Dimension dimension) {
    const double value = text_number(s, dimension);
    must(value > 0, s.origin, "<" + s.name + "> must be positive");
    return value;
  };
  if (s.name == "KIc")
    t.KIc = above_zero(Dimension::stress_intensity);
  else if (s.name == "KIIc")
    t.KIIc = above_zero(Dimension::stress_intensity);
  else if (s.name == "JIc")
    t.JIc = above_zero(Dimension::energy_release);
  else if (s.name == "KIexp")
    t.KIexp = above_zero(Dimension::none);
  else if (s.name == "KIIexp")
    t.KIIexp = above_zero(Dimension::none);
  else
    spec.growth = growth(s);
}

Growth Builder::growth(const Statement& s) {
  using When = Growth::When;
  static constexpr std::array criteria{std::pair(0, When::never), std::pair(1, When::hoop_stress),
                                       std::pair(4, When::energy_density), std::pair(5, When::empirical),
                                       std::pair(7, When::release_rate)};
  Growth out;
  const auto asked = static_cast<int>(number(s, "criterion", Dimension::none, 1));
  const auto* found = std::find_if(criteria.begin(), criteria.end(), [&](const auto& c) { return c.first == asked; });
  must(found != criteria.end(), s.origin,
       "there is no criterion " + std::to_string(asked) +
           "; valid: 0 (none), 1 (maximum hoop stress), 4 (strain energy density), 5 (empirical), 7 (energy release "
           "rate)");
  if (found != criteria.end()) out.when = found->second;
  const auto way = static_cast<int>(number(s, "direction", Dimension::none, 0));
  must(way >= 0 && way <= 4, s.origin,
       "'direction' is 0 (of the criterion), 1 (along the crack), 2 (normal to the opening displacement), 3 (maximum "
       "hoop "
       "stress derived from the opening displacement) or 4 (initial direction)");
  out.way = static_cast<Growth::Way>(std::clamp(way, 0, 4));
  must(number(s, "traction", Dimension::none, 0) == 0, s.origin,
       "a traction law for new parts of a crack is not implemented; define the crack along its whole expected path and "
       "give its parts a traction law (mat)");
  return out;
}

// Needs materials and cracks to be read.
void Builder::fracture() {
  const Statement* general = root_.child("MPMHeader")->child("Cracks");
  const Statement* contour = general ? general->child("JContour") : nullptr;
  const Statement* propagate = general ? general->child("Propagate") : nullptr;
  FractureSpec spec;
  if (contour) {
    spec.size = number(*contour, "size", Dimension::none, spec.size);
    must(spec.size >= 1 && spec.size <= 20, contour->origin,
         "'size' is the radius of the contour in cells, from 1 to 20");
    must(number(*contour, "type", Dimension::none, 1) == 1, contour->origin, "the only type is 1");
    const double terms = number(*contour, "terms", Dimension::none, 2);
    must(terms == 1 || terms == 2, contour->origin, "'terms' must be 1 (without the inertia term) or 2 (with it)");
    spec.inertia = terms != 1;
  }
  if (const Statement* hop = general ? general->child("PropagateLength") : nullptr) {
    spec.hop = text_number(*hop, Dimension::none);
    must(spec.hop > 0 && spec.hop <= 2, hop->origin, "<PropagateLength> is a length in cells, up to 2");
  }
  const Growth for_all = propagate ? growth(*propagate) : Growth{};
  bool grows = false, tough = false;
  Origin origin = contour ? contour->origin : propagate ? propagate->origin : wants_tip_loads_.value_or(Origin{});
  for (std::size_t m = 0; m < model_.materials.size(); ++m) {
    MaterialSpec& material = model_.materials[m];
    const Statement* own = material.statement.child("Propagate");
    if (!own) material.growth = for_all;
    if (!material.law || material.growth.when == Growth::When::never) continue;
    if (own && !origin.file) origin = own->origin;
    grows = true;
    const std::string missing = missing_toughness(material);
    if (!missing.empty()) {
      must(!own, material.origin, "the growth of cracks in '" + material.name + "' needs " + missing);
      tough = tough || own;
      material.growth.when = Growth::When::never;
      continue;
    }
    tough = true;
    must(material.growth.when == Growth::When::release_rate || elastic_moduli(*material.law), material.origin,
         "stress intensity factors need an isotropic material; for '" + material.name +
             "' use criterion 7, which needs <JIc>");
  }
  if (!contour && !grows && !wants_tip_loads_) return;
  must(!grows || tough, origin, "no material has a fracture toughness: give <KIc>, or <JIc> for criterion 7");
  must(model_.analysis == Analysis::plane_strain || model_.analysis == Analysis::plane_stress, origin,
       "crack tips are evaluated in plane strain and plane stress only");
  must(!model_.cracks.empty(), origin, "there is no crack; add a <CrackList>");
  for (const CrackSpec& crack : model_.cracks)
    must(!grows || !crack.joint || crack.ends == std::array{CrackSpec::End::none, CrackSpec::End::none}, crack.origin,
         "a crack with a joint law cannot grow, since its new parts would have no joint law; set start_tip and end_tip "
         "to -1");
  model_.fracture = spec;
}

std::string Builder::missing_toughness(const MaterialSpec& material) {
  const Toughness& t = material.toughness;
  switch (material.growth.when) {
    case Growth::When::never:
      return "";
    case Growth::When::hoop_stress:
    case Growth::When::energy_density:
      return t.KIc ? "" : "<KIc>";
    case Growth::When::empirical:
      return t.KIc && t.KIIc ? "" : "<KIc> and <KIIc>";
    case Growth::When::release_rate:
      return t.JIc ? "" : "<JIc>";
  }
  return "";
}

}  // namespace tribo
