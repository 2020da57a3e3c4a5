// SPDX-License-Identifier: MIT
/// The manual of all names: elements, properties, commands and quantities, generated from the tables that the program
/// uses.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// A row of an entry: an attribute or a parameter.
struct ManualRow {
  std::string name, kind, meaning;
};

struct ManualEntry {
  std::string kind;   ///< "element", "material", "contact law", "custom task", "command", "history", "field"
  std::string name;   ///< as written
  std::string usage;  ///< elements that may contain it, or arguments of a command
  std::string meaning;
  std::vector<ManualRow> rows = {};
  std::string needs = {};    ///< laws: which properties that are not required alone are required together
  std::string example = {};  ///< as in a command file
  std::string script = {};   ///< materials and laws: the same in a script
};

/// All entries, grouped by kind, in the order of their tables.
const std::vector<ManualEntry>& manual();

/// The entries with this name, in any case, as text; if there is none, the attributes and properties with this name;
/// if there are none, a line for each entry that mentions it; all entries if it is empty. Throws UsageError with the
/// most similar name if there is nothing of this name.
std::string manual_text(std::string_view name = {});
/// A list with one line per entry.
std::string manual_list();
/// The manual as Markdown.
std::string manual_markdown();
/// Every name once, one per line, for command line completion.
std::string manual_names();

}  // namespace tribo
