// SPDX-License-Identifier: MIT
/// Search of tables by name.
#pragma once

#include <algorithm>
#include <cctype>
#include <string_view>

namespace tribo {

/// Equality without regard to case.
inline bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// The entry of a table with this name in any case, or null.
template <class Table>
auto find_name(const Table& table, std::string_view name) {
  const auto entry = std::find_if(table.begin(), table.end(), [&](const auto& e) { return same_name(e.name, name); });
  return entry == table.end() ? nullptr : &*entry;
}

}  // namespace tribo
