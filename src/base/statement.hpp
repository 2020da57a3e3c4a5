// SPDX-License-Identifier: MIT
/// What the user wrote, in either language, with the place of every word.
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

/// One XML element, or the script command that means the same: `<Material Type="8" Name="rubber"> ... </Material>`.
/// Readers of both languages produce a tree of these; what they mean is decided once, in input/.
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
