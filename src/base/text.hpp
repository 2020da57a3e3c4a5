// SPDX-License-Identifier: MIT
/// Functions for text.
#pragma once

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

/// Text for XML and HTML: & < > as entities, and also `quote`, the quotation mark that encloses the text.
std::string escaped(std::string_view text, char quote = '"');

}  // namespace tribo
