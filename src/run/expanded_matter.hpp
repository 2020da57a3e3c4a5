// SPDX-License-Identifier: MIT
/// What the summary of a run says about flowing matter that has become larger.
#pragma once

#include "model/model.hpp"
#include "solver/state/system.hpp"

#include <string>
#include <vector>

namespace tribo {

/// One line for each body of sand, clay or liquid whose particles together have more than 1.02 times their initial
/// volume. Such matter expands rightly where it dilates or flies apart; a deposit at rest that has expanded shows an
/// error of the transfer, for which the line names a remedy.
template <int Dim>
std::vector<std::string> expanded_matter(const Model& model, System<Dim>& system);

}  // namespace tribo
