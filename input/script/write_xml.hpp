// SPDX-License-Identifier: MIT
/// Statements -> XML, for people to read.
#pragma once

#include "base/statement.hpp"

#include <string>

namespace tribo {

/// A command file; each element of the upper levels says in a comment which line of the script it came from.
std::string xml_text(const Statement& root);

}  // namespace tribo
