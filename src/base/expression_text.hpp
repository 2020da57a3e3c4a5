// SPDX-License-Identifier: MIT
/// The grammar of expressions: what `Expression` accepts, before muParser compiles it.
#pragma once

#include "base/error.hpp"

#include <string>
#include <vector>

namespace tribo {

/// A function of the language: `most` arguments at the most, 0: any number.
struct FunctionName {
  std::string_view name;
  int least = 1, most = 1;
};

/// All functions, by name.
const std::vector<FunctionName>& expression_functions();
/// All variables; case matters.
const std::vector<std::string>& expression_variables();

/// An expression that is known to be well formed.
struct CheckedText {
  std::string program;  ///< canonical: functions in lower case, numbers in shortest form, `#` for ^, one sign at a time
  bool uses_variables = false;
  bool uses_start = false;  ///< one of them is x0, y0 or z0
};

/// Throws InputError at the offending character, with what is valid.
CheckedText check_expression(const std::string& text, const Origin& origin);

/// The place of character `offset` of a text that starts at `origin`.
Origin origin_inside(const Origin& origin, const std::string& text, std::size_t offset);

}  // namespace tribo
