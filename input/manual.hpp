// SPDX-License-Identifier: MIT
/// What every name means: elements, properties, commands, quantities. Made of the tables that the program itself uses.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// A part of an entry: an attribute, a parameter.
struct ManualRow {
  std::string name, kind, meaning;
};

struct ManualEntry {
  std::string kind;   ///< "element", "material", "contact law", "command", "history", "field"
  std::string name;   ///< as written
  std::string usage;  ///< where it may be, or what follows it
  std::string meaning;
  std::vector<ManualRow> rows = {};
};

/// All entries, those of a kind together, in the order of their tables.
const std::vector<ManualEntry>& manual();

/// The entries of this name in any case, as text; of all if it is empty. Throws UsageError with the nearest name if
/// there is none.
std::string manual_text(std::string_view name = {});
/// One line per entry.
std::string manual_list();
/// The manual as Markdown.
std::string manual_markdown();
/// Every name once, one per line, for completion.
std::string manual_names();

}  // namespace tribo
