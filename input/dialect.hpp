// SPDX-License-Identifier: MIT
/// The keywords of command files. This one table is used for reading, error messages, the XSD and the manual.
#pragma once

#include "base/statement.hpp"
#include "base/units.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// Form of a value.
enum class ValueType {
  none,
  text,
  number,
  integer,
  coordinate,  ///< a number, or `min`, `max`, `min+2`, `max-1.5`, `max+` (cells from the edge of the grid)
  function,    ///< of x, y, z, t
  flag,        ///< yes, no, 1, 0
  choice,
  version  ///< of the format, such as 3 or 3.2
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
  ValueType content = ValueType::none;  ///< form of the text content
  std::vector<AttributeSpec> attributes{};
  bool once = false;           ///< at most one in its parent
  bool required = false;       ///< at least one in its parent
  bool shape = false;          ///< belongs to @shape
  std::string_view choices{};  ///< admissible words of the text content
  std::string_view unless{};   ///< not required if this sibling is present
};

/// All elements that Tribo understands.
const std::vector<ElementSpec>& dialect();

/// Names of NairnMPM that Tribo does not support, with the reason.
struct RefusedName {
  std::string_view name;
  std::string_view reason;
};
const std::vector<RefusedName>& refused_names();

/// Attributes, by the elements that have them; both lists are separated by blanks.
struct RefusedAttribute {
  std::string_view elements, names, reason;
};
const std::vector<RefusedAttribute>& refused_attributes();
/// Properties of materials.
const std::vector<RefusedName>& refused_properties();
/// Types of materials by numbers and names, separated by blanks.
struct RefusedType {
  std::string_view words, reason;
};
const std::vector<RefusedType>& refused_types();
const std::vector<RefusedName>& refused_tasks();
/// Quantities of histories and fields of files.
const std::vector<RefusedName>& refused_outputs();

/// Tasks of <CustomTasks>, and whether a task has a parameter (build_tasks.cpp).
const std::vector<std::string>& task_names();
std::vector<std::string> parameter_names(const std::string& task);
/// What a parameter of a task means; empty for those that are fields.
std::string_view meaning_of_parameter(std::string_view task, std::string_view name);
/// Which of its parameters a task needs, for the manual; empty: none.
std::string_view needs_of_task(std::string_view task);
bool knows_parameter(const std::string& task, const std::string& name);
/// Why the parameter of a task is refused; empty if it is not.
std::string_view reason_against_parameter(std::string_view name);

/// Why a name of the list is refused, irrespective of case; empty if it is not in the list.
std::string_view reason_against(const std::vector<RefusedName>& list, std::string_view name);
std::string_view reason_against_attribute(std::string_view element, std::string_view attribute);
std::string_view reason_against_type(std::string_view word);
/// The same for a word of an element's text or attribute that has a list of words.
std::string_view reason_against_word(std::string_view element, std::string_view word);

/// The spec of an element inside a parent, or null.
const ElementSpec* find_element(std::string_view name, std::string_view parent);

/// Checks a tree against the table: names, places, repetitions, missing elements and the form of every value.
/// Properties of <Material> are checked by the law. `only_drive`: for `tribo drive` the sections of a model are not
/// required.
void check_statements(const Statement& root, Problems& problems, bool only_drive = false);

/// Whether all elements are known, all that is required is there, and the header and the grid have no problem: then the
/// model can be built to find problems of its values, whatever else is wrong.
bool is_complete(const Statement& root);

/// A tree without the elements that are unknown or lack something required, as far as they may be left out.
Statement complete_part(const Statement& root);

/// XML schema of the format as Tribo reads it.
std::string schema();

}  // namespace tribo
