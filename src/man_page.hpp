// SPDX-License-Identifier: MIT
/// The manual page of the program.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tribo {

/// The page tribo(1) in the format of `man`, generated from the commands and options of the program.
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace tribo
