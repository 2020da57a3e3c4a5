// SPDX-License-Identifier: MIT
/// The keywords of command files: one table that reading, error texts, the XSD and the manual follow from.
#pragma once

#include "base/statement.hpp"
#include "base/units.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// What a value may look like.
enum class ValueType {
  none,
  text,
  number,
  integer,
  coordinate,  ///< a number, or `min`, `max`, `min+2`, `max-1.5`, `max+` (cells from the edge of the grid)
  function,    ///< of x, y, z, t
  flag,        ///< yes, no, 1, 0
  choice
};

struct AttributeSpec {
  std::string_view name;
  ValueType type = ValueType::number;
  std::string_view meaning;
  std::string_view choices{};  ///< separated by blanks
  bool required = false;
};

struct ElementSpec {
  std::string_view name;
  std::string_view parents;  ///< separated by blanks; `@shape` stands for every shape
  std::string_view meaning;
  ValueType content = ValueType::none;  ///< of the text
  std::vector<AttributeSpec> attributes{};
  bool once = false;           ///< at most one in its parent
  bool required = false;       ///< at least one in its parent
  bool shape = false;          ///< belongs to @shape
  std::string_view choices{};  ///< of the text
  std::string_view unless{};   ///< a sibling beside which it is not required
};

/// All elements that Tribo understands.
const std::vector<ElementSpec>& dialect();

/// Names of the dialect that Tribo knows and refuses, with the reason.
struct RefusedName {
  std::string_view name;
  std::string_view reason;
};
const std::vector<RefusedName>& refused_names();

/// The spec of an element inside a parent, or null.
const ElementSpec* find_element(std::string_view name, std::string_view parent);

/// Checks a tree against the table: names, places, repetitions, what is missing, and the form of every value.
/// The children of <Material> that are properties are left to the law. `only_drive`: a file to drive a law with needs
/// no model.
void check_statements(const Statement& root, Problems& problems, bool only_drive = false);

/// XML schema of the dialect as Tribo reads it.
std::string schema();

}  // namespace tribo
