// SPDX-License-Identifier: MIT
/// The contact laws of a model before it runs.
#pragma once

#include "model/model.hpp"
#include "solver/state/system.hpp"

#include <string>
#include <vector>

namespace tribo {

/// One line for each contact law with the pairs of materials that it acts between, and one that says where the contact
/// conditions hold. If several pairs have the commonest law, they are not listed one by one: "contact of all other
/// pairs (66): friction 0.3". Of a system before the first step.
template <int Dim>
std::vector<std::string> contact_table(const Model& model, const System<Dim>& system);

}  // namespace tribo
