// SPDX-License-Identifier: MIT
/// Children of <Material> that are not parameters of a law.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace tribo {

/// Heat properties and properties of the display.
inline const std::vector<std::string> quiet_properties{"alpha",  "Cv",     "Cp",     "kCond",  "TaylorQuinney", "color",
                                                       "alphaA", "alphaT", "alphax", "alphay", "alphaz"};
/// Thermal expansion of anisotropic materials, which has no effect at a constant temperature.
inline bool of_anisotropic_expansion(const std::string& name) {
  return name.size() == 6 && name.rfind("alpha", 0) == 0;
}
/// Properties of all deformable materials.
inline const std::vector<std::string> common_properties{"PDamping", "largeRotation", "Friction", "shareMatField"};
/// Properties of rigid materials.
inline const std::vector<std::string> rigid_properties{"SetDirection", "SettingFunction", "SettingFunction2",
                                                       "SettingFunction3", "mirrored"};

/// Properties of the growth of cracks.
inline const std::vector<std::string> growth_properties{"KIc", "KIIc", "JIc", "KIexp", "KIIexp", "Propagate"};
inline bool of_cracks(const std::string& name) {
  return std::find(growth_properties.begin(), growth_properties.end(), name) != growth_properties.end();
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
