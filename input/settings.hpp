// SPDX-License-Identifier: MIT
/// Values that are set on the command line for variables of scripts and entities of XML files.
#pragma once

#include <map>
#include <set>
#include <string>

namespace tribo {

/// Values by name, with or without the prefix '#' or '$' of script variables.
class Settings {
 public:
  Settings() = default;
  Settings(std::map<std::string, std::string> values) : values_(std::move(values)) {}  // NOLINT: they are the settings

  /// The value of a variable or an entity, or null. A name that was looked up counts as used.
  const std::string* find(const std::string& variable) {
    seen_.insert(plain(variable));
    for (const auto& [name, value] : values_)
      if (plain(name) == plain(variable)) return &value;
    return nullptr;
  }
  const std::map<std::string, std::string>& values() const { return values_; }
  /// Names of all variables and entities that can be set.
  const std::set<std::string>& seen() const { return seen_; }
  bool used(const std::string& name) const { return seen_.count(plain(name)) > 0; }

 private:
  static std::string plain(std::string name) {
    if (!name.empty() && name.front() == '#') name.erase(0, 1);
    if (!name.empty() && name.back() == '$') name.pop_back();
    return name;
  }

  std::map<std::string, std::string> values_;
  std::set<std::string> seen_;
};

}  // namespace tribo
