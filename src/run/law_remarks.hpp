// SPDX-License-Identifier: MIT
/// Remarks on contact laws that do not act as their place in the command file suggests.
#pragma once

#include "model/model.hpp"

#include <string>
#include <vector>

namespace tribo {

/// Contact laws that no pair of bodies and no crack uses in any stage, and a method for normals that does not suit
/// impulses on faces.
std::vector<std::string> remarks_on_contact_laws(const Model& model);

}  // namespace tribo
