// SPDX-License-Identifier: MIT
/// What a variable of a script holds, and the places where it may be kept.
#pragma once

#include "base/error.hpp"

#include <map>
#include <string>
#include <variant>

namespace tribo::script {

/// A number or a text.
using Value = std::variant<double, std::string>;

inline bool is_text(const Value& v) { return std::holds_alternative<std::string>(v); }

/// As it is joined to other text: numbers with eight significant digits, as the dialect prints them.
std::string printed(const Value& v);
/// As it becomes an argument of a command: numbers with all digits that count.
std::string written(const Value& v);

/// All variables; elements of arrays are variables named `#a[2]`. Names differ by case.
using Variables = std::map<std::string, Value, std::less<>>;

}  // namespace tribo::script
