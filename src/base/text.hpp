// SPDX-License-Identifier: MIT
/// Small things that are done to text.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// In lower case, ASCII only.
std::string lower(std::string_view text);

/// What stands between blanks.
std::vector<std::string> words_of(std::string_view text);

/// Values in a pattern of printf.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::string out(static_cast<std::size_t>(std::snprintf(nullptr, 0, pattern, values...)), '\0');
  std::snprintf(out.data(), out.size() + 1, pattern, values...);
  return out;
}

/// For XML and HTML: & < > as entities, and `quote`, if the text stands between such.
std::string escaped(std::string_view text, char quote = '"');

}  // namespace tribo
