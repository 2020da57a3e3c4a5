// SPDX-License-Identifier: MIT
/// Functions of texts in scripts: length, words, replace, ...
#pragma once

#include "input/script/value.hpp"

#include <functional>
#include <vector>

namespace tribo::script {

struct TextFunction {
  std::string_view name;
  std::size_t least, most;  ///< arguments
  std::string arguments;    ///< in words
  std::function<Value(const std::vector<Value>&, const std::function<double(const Value&)>& number)> value;
};

/// The function of a name (any case), or null.
const TextFunction* find_text_function(std::string_view name);
/// Names for messages.
std::string text_function_names();

}  // namespace tribo::script
