// SPDX-License-Identifier: MIT
/// Expressions of scripts: numbers and texts, variables, functions.
#pragma once

#include "input/script/value.hpp"

#include <string_view>

namespace tribo::script {

/// A piece of a line and where it begins.
struct Piece {
  std::string text;
  Origin origin;
};

/// The value of an expression. From strongest to weakest: parentheses and functions, ^ (left to right), a leading sign,
/// * / and % (remainder), + and -, & (joins texts). Throws InputError at the offending character.
Value evaluate(const Piece& piece, const Variables& variables);

/// The value as a number; throws InputError if it is a text that is none.
double evaluate_number(const Piece& piece, const Variables& variables);

/// Text between blanks at both ends removed, the place moved along.
Piece trimmed(const Piece& piece);

/// An argument of a command: an expression, or words that are no expression and mean themselves, as `velocity`,
/// `3*t` or `My Material`. Words that contain a variable must be an expression.
std::string argument(const Piece& piece, const Variables& variables);

/// A condition: comparisons of expressions (= == is != > >= < <=) joined by && and ||, && first. Texts are equal by =
/// and `is` whatever their case. A comparison without an operator is true if its value is a number that is not 0.
bool condition(const Piece& piece, const Variables& variables);

/// Pieces between separators that are outside quotes, parentheses and brackets.
std::vector<Piece> split(const Piece& piece, std::string_view separator);

/// The name of the variable or array element that a piece names: `#a`, `#a[#i+1]` -> `#a[3]`.
std::string variable_name(const Piece& piece, const Variables& variables);

/// Whether a character may be in a name, and may begin one.
bool name_begins(char c);
bool in_name(char c);

}  // namespace tribo::script
