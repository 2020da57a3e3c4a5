// SPDX-License-Identifier: MIT
/// Scripted commands -> statements.
#pragma once

#include "base/statement.hpp"
#include "input/settings.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace tribo {

/// What a script means.
struct Script {
  Statement root;      ///< the command file it stands for; its places are those of the script
  std::string output;  ///< what `Write` and `WriteLine` wrote
};

/// Runs a script, which does not change the variables in the settings. Throws InputError with every problem
/// found, each with the calls and loops it was reached through.
Script read_script(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings);

/// Runs the scripts in <Commands> of an XML file and puts what they say into its sections. Returns what they wrote.
/// Throws like read_script.
std::string run_commands(Statement& root, Settings& settings);

/// Whether a text is a script, not XML.
bool is_script(std::string_view text);

}  // namespace tribo
