// SPDX-License-Identifier: MIT
/// Stages as changes of the statements of a command file.
#pragma once

#include "base/statement.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// Positions of the materials among those of the file, in the order of their numbers: those to which an element refers
/// by name come first, in the order of the references.
std::vector<std::size_t> material_order(const Statement& root);

/// Position, among the materials of the file, of the one that <Material> of a stage changes; none after a problem.
/// `order`: as above.
std::optional<std::size_t> material_of_stage(const Statement& root, const Statement& change,
                                             const std::vector<std::size_t>& order, Problems& problems);

/// Applies what a stage changes for good to the tree. Bodies, excavations and bonds are actions, not changes of the
/// tree.
void apply_stage(Statement& root, const Statement& stage, const std::vector<std::size_t>& order, Problems& problems);

/// What a stage does, a phrase each.
std::vector<std::string> phrases_of(const Statement& stage, const Statement& root,
                                    const std::vector<std::size_t>& order);

}  // namespace tribo
