// SPDX-License-Identifier: MIT
/// Text functions of scripts: length, words, replace, ...
#pragma once

#include "input/script/value.hpp"

#include <functional>
#include <vector>

namespace tribo::script {

struct TextFunction {
  std::string_view name;
  std::size_t least, most;  ///< number of arguments
  std::string arguments;    ///< description for messages
  std::function<Value(const std::vector<Value>&, const std::function<double(const Value&)>& number)> value;
};

/// The function with this name, in any case, or null.
const TextFunction* find_text_function(std::string_view name);
/// Names of all functions, for messages.
std::string text_function_names();

}  // namespace tribo::script
