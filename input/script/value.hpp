// SPDX-License-Identifier: MIT
/// Values and variables of scripts.
#pragma once

#include "base/error.hpp"

#include <map>
#include <string>
#include <variant>

namespace tribo::script {

/// A number or a text.
using Value = std::variant<double, std::string>;

inline bool is_text(const Value& v) { return std::holds_alternative<std::string>(v); }

/// Text of a value for concatenation: numbers with eight significant digits, as in NairnFEAMPM.
std::string printed(const Value& v);
/// Text of a value as an argument of a command: numbers with all significant digits.
std::string written(const Value& v);

/// All variables; elements of arrays are variables named `#a[2]`. Names are case-sensitive.
using Variables = std::map<std::string, Value, std::less<>>;

}  // namespace tribo::script
