// SPDX-License-Identifier: MIT
/// The grammar of expressions, which are checked before muParser compiles them.
#pragma once

#include "base/error.hpp"

#include <string>
#include <vector>

namespace tribo {

/// A function of the language. `most`: largest number of arguments, 0: any number.
struct FunctionName {
  std::string_view name;
  int least = 1, most = 1;
};

/// All functions.
const std::vector<FunctionName>& expression_functions();
/// All variables (case-sensitive).
const std::vector<std::string>& expression_variables();

/// A well-formed expression.
struct CheckedText {
  std::string program;  ///< canonical form: functions in lower case, shortest numbers, `#` for ^, single signs
  bool uses_variables = false;
  bool uses_start = false;  ///< one of them is x0, y0 or z0
  bool uses_place = false;  ///< one of them depends on the present position
};

/// Throws InputError at the offending character, with what is valid.
CheckedText check_expression(const std::string& text, const Origin& origin);

/// The place of character `offset` of a text that starts at `origin`.
Origin origin_inside(const Origin& origin, const std::string& text, std::size_t offset);

}  // namespace tribo
