// SPDX-License-Identifier: MIT
/// The commands of scripts. The translator, error messages and the manual use the same table.
#pragma once

#include "input/dialect.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace tribo::script {

struct CommandInfo {
  std::string_view name;
  std::size_t least, most;  ///< number of arguments
  std::string_view arguments;
  std::string_view meaning;
};

/// Commands that build the model.
const std::vector<CommandInfo>& commands();
/// Lines of `Blocks ... EndBlocks`, one for each element inside <Blocks> in the table of keywords.
const std::vector<CommandInfo>& lines_of_blocks();
/// The element inside <Blocks> with this name, irrespective of case, or null.
const ElementSpec* find_element_of_blocks(std::string_view name);
/// Commands of the language itself, which check their arguments themselves.
const std::vector<CommandInfo>& language();

/// A command of NairnFEAMPM that Tribo does not have.
struct RefusedCommand {
  std::string_view name, reason;
};
const std::vector<RefusedCommand>& refused_commands();

}  // namespace tribo::script
