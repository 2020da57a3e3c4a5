// SPDX-License-Identifier: MIT
/// Expressions of scripts: numbers and texts, variables, functions.
#pragma once

#include "input/script/value.hpp"

#include <string_view>

namespace tribo::script {

/// A part of a line and its place.
struct Piece {
  std::string text;
  Origin origin;
};

/// The value of an expression. Operators by decreasing precedence: parentheses and functions, ^ (left to right), a
/// leading sign,
/// * / and % (remainder), + and -, & (joins texts). Throws InputError at the offending character.
Value evaluate(const Piece& piece, const Variables& variables);

/// The value as a number; throws InputError if it is a text that is not a number.
double evaluate_number(const Piece& piece, const Variables& variables);

/// The text without blanks at both ends, with its place.
Piece trimmed(const Piece& piece);

/// An argument of a command: the value of an expression, or a literal text such as `velocity`, `3*t` or `My Material`.
/// A text that contains a variable must be an expression.
std::string argument(const Piece& piece, const Variables& variables);

/// A condition: comparisons of expressions (= == is != > >= < <=) joined by && and ||, && first. = and
/// `is` compare texts without regard to case. A comparison without an operator is true if its value is a number that is
/// not 0.
bool condition(const Piece& piece, const Variables& variables);

/// Parts between separators that are outside quotes, parentheses and brackets.
std::vector<Piece> split(const Piece& piece, std::string_view separator);

/// The name of a variable or array element: `#a`, `#a[#i+1]` -> `#a[3]`.
std::string variable_name(const Piece& piece, const Variables& variables);

/// Whether a character may be in a name, and may begin one.
bool name_begins(char c);
bool in_name(char c);

}  // namespace tribo::script
