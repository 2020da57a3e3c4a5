// SPDX-License-Identifier: MIT
/// Command line completion of the program's commands.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tribo {

/// Completion script for `bash` or `zsh`, generated from the commands and options of the program.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace tribo
