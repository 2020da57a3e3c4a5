// SPDX-License-Identifier: MIT
/// Python source text: values, names and calls.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo::script {

/// The value of an argument of a command as Python has it: a number, or a text in quotes.
std::string python_value(const std::string& text);

/// Lines as one text in triple quotes.
std::string python_lines(const std::string& text);

/// Whether a name may be that of a keyword argument.
bool is_python_name(const std::string& name);

/// The method of tribo.Model for a command: GridEdge is grid_edge.
std::string python_method(std::string_view command);

/// `begin(argument, ...)end`, on several lines if it is long; `indent` are the blanks in front of it.
std::string python_call(const std::string& begin, const std::vector<std::string>& arguments, const std::string& end,
                        std::size_t indent);

}  // namespace tribo::script
