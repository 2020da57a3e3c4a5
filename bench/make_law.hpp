// SPDX-License-Identifier: MIT
/// Makes materials and contact laws.
#pragma once

#include "base/catalogue.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tribo {

/// The law `name` of a catalogue with the given parameters.
template <class Law>
std::shared_ptr<Law> make(const Catalogue<Law>& all, std::string_view name,
                          const std::vector<std::pair<std::string, std::string>>& parameters) {
  Statement statement;
  for (const auto& [key, value] : parameters) {
    Statement child;
    child.name = key, child.text = value;
    statement.children.push_back(child);
  }
  Problems problems;
  auto law = all.find(name)->make(statement, {}, Units{}, problems);
  problems.raise();
  return std::shared_ptr<Law>(std::move(law));
}

}  // namespace tribo
