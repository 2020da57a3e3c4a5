// SPDX-License-Identifier: MIT
/// What makes a shell complete the program's commands.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tribo {

/// A script for `bash` or `zsh`, made of the commands and options that the program knows.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace tribo
