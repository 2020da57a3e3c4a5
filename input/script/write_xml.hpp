// SPDX-License-Identifier: MIT
/// Writes statements as readable XML.
#pragma once

#include "base/statement.hpp"

#include <string>

namespace tribo {

/// The text of a command file. Comments at the upper levels give the lines of the script from which elements came.
std::string xml_text(const Statement& root);

}  // namespace tribo
