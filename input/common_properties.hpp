// SPDX-License-Identifier: MIT
/// Children of <Material> that are not parameters of a law.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace tribo {

/// Heat properties and properties of the display.
inline const std::vector<std::string> quiet_properties{"alpha", "Cv", "Cp", "kCond", "TaylorQuinney", "color"};
/// Properties of all deformable materials.
inline const std::vector<std::string> common_properties{"PDamping", "largeRotation", "ArtificialVisc", "Friction",
                                                        "shareMatField"};
/// Properties of rigid materials.
inline const std::vector<std::string> rigid_properties{"SetDirection", "SettingFunction", "SettingFunction2",
                                                       "SettingFunction3", "mirrored"};

/// Fracture properties: those that are implemented, and others of NairnMPM.
inline const std::vector<std::string> growth_properties{"KIc", "KIIc", "JIc", "KIexp", "KIIexp", "Propagate"};
inline const std::vector<std::string> fracture_properties{
    "KIc",      "KIIc",  "JIc",       "JIIc",  "KIexp", "KIIexp",      "delIc",     "delIIc",       "nmix",
    "initTime", "speed", "maxLength", "xGrow", "yGrow", "constantTip", "Propagate", "AltPropagate", "allowsCracks"};
inline bool of_cracks(const std::string& name) {
  return std::find(fracture_properties.begin(), fracture_properties.end(), name) != fracture_properties.end();
}
inline std::string why_not(const std::string& fracture_property) {
  return "<" + fracture_property + "> belongs to a criterion for the growth of cracks that is not implemented";
}

/// Whether a property may occur in a <Material>, irrespective of its law.
inline bool of_no_law(const std::string& name) {
  const auto in = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  return name == "rho" || in(quiet_properties) || in(common_properties) || in(rigid_properties) ||
         in(growth_properties);
}

}  // namespace tribo
