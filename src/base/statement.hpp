// SPDX-License-Identifier: MIT
/// Statements: the contents of a command file, XML or script, with the place of each part.
#pragma once

#include "base/error.hpp"

#include <string>
#include <vector>

namespace tribo {

/// One attribute exactly as written.
struct Attribute {
  std::string name;
  std::string text;
  Origin origin;
};

/// One XML element, or the equivalent script command: `<Material Type="8" Name="rubber"> ... </Material>`.
/// The readers of both languages produce a tree of statements; input/ interprets it.
struct Statement {
  std::string name;
  Origin origin;
  std::vector<Attribute> attributes;
  std::string text;  ///< text content without leading and trailing blanks; entities expanded
  Origin text_origin;
  std::vector<Statement> children;

  /// The attribute of this name, or null.
  const Attribute* attribute(std::string_view wanted) const {
    for (const auto& a : attributes)
      if (a.name == wanted) return &a;
    return nullptr;
  }
  /// The first child of this name, or null.
  const Statement* child(std::string_view wanted) const {
    for (const auto& c : children)
      if (c.name == wanted) return &c;
    return nullptr;
  }
};

}  // namespace tribo
