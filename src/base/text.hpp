// SPDX-License-Identifier: MIT
/// Functions for text.
#pragma once

#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// The text in lower case, ASCII only.
std::string lower(std::string_view text);

/// The words between blanks.
std::vector<std::string> words_of(std::string_view text);

/// A formatted text, with a format of printf.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::string out(static_cast<std::size_t>(std::snprintf(nullptr, 0, pattern, values...)), '\0');
  std::snprintf(out.data(), out.size() + 1, pattern, values...);
  return out;
}

/// A noun in the singular, or in the plural that is formed with s.
std::string plural(bool one, std::string_view noun);

/// A number with its noun: "1 cell", "2 cells", "0.5 cells", and "1 cell" also for what `pattern` rounds to 1.
/// `noun` is in the singular.
std::string counted(double number, std::string_view noun, const char* pattern = "%.2g");
/// The same of a whole number, with all its digits.
template <std::integral Count>
std::string counted(Count number, std::string_view noun) {
  return std::to_string(number) + " " + plural(number == 1, noun);
}

/// Text for XML and HTML: & < > as entities, and also `quote`, the quotation mark that encloses the text.
std::string escaped(std::string_view text, char quote = '"');

}  // namespace tribo
