// SPDX-License-Identifier: MIT
/// Numbers as text: shortest form that reads back to the same bits.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace tribo {

inline std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

/// 0 for text that is no number.
inline double parse_number(std::string_view text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace tribo
