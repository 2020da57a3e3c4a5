// SPDX-License-Identifier: MIT
/// Name -> maker and manual page, for materials and contact laws. Generated lists, no static objects, no macros.
#pragma once

#include "base/schema.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// A property that is a word or a list, which the law reads itself; without a meaning: one that it refuses with a
/// reason.
struct OwnProperty {
  std::string_view name, meaning;
};

template <class Base>
class Catalogue {
 public:
  struct Item {
    std::string name;                  ///< as written in the input, e.g. `MohrCoulomb`
    std::string summary;               ///< one sentence
    int number = 0;                    ///< type number in the NairnMPM dialect; 0: has none
    std::vector<std::string> aliases;  ///< further accepted names
    std::vector<ParameterInfo> parameters;
    std::vector<OwnProperty> own_properties;
    /// Reads the properties of a <Material> element; problems are collected, null if there were any.
    std::unique_ptr<Base> (*make)(const Statement&, const std::vector<std::string>& handled_elsewhere, const Units&,
                                  Problems&) = nullptr;
  };

  explicit Catalogue(std::vector<Item> items) : items_(std::move(items)) {}
  const std::vector<Item>& items() const { return items_; }

  /// By name (any case), alias or dialect number; null if there is none.
  const Item* find(std::string_view word) const {
    const auto same = [](std::string_view a, std::string_view b) {
      if (a.size() != b.size()) return false;
      for (std::size_t i = 0; i < a.size(); ++i)
        if ((a[i] | 32) != (b[i] | 32)) return false;
      return true;
    };
    for (const auto& item : items_) {
      if (same(item.name, word) || (item.number != 0 && std::to_string(item.number) == word)) return &item;
      for (const auto& alias : item.aliases)
        if (same(alias, word)) return &item;
    }
    return nullptr;
  }

 private:
  std::vector<Item> items_;
};

/// Catalogue entry of `Law`, which has name, summary, number, parameters(), prepare() and, if it reads some properties
/// itself, own_properties(). `Host` is what the engine calls, made from the law it was given: the law itself or an
/// adaptor.
template <class Base, class Law, class Host>
typename Catalogue<Base>::Item catalogue_item(const std::vector<std::string>& aliases) {
  typename Catalogue<Base>::Item item;
  item.name = Law::name;
  item.summary = Law::summary;
  item.number = Law::number;
  item.aliases = aliases;
  for (const auto& p : Law::parameters()) item.parameters.push_back(p.info());
  if constexpr (requires { Law::own_properties(); }) item.own_properties = Law::own_properties();
  item.make = [](const Statement& statement, const std::vector<std::string>& handled_elsewhere, const Units& units,
                 Problems& problems) -> std::unique_ptr<Base> {
    Law law;
    Problems mine;
    if constexpr (requires { Law::own_properties(); }) {
      auto skipped = handled_elsewhere;
      for (const auto& p : Law::own_properties()) skipped.emplace_back(p.name);
      read_law(law, statement, skipped, units, mine);
    } else {
      read_law(law, statement, handled_elsewhere, units, mine);
    }
    if constexpr (requires { law.prepare(statement, units, mine); }) {
      if (mine.empty()) law.prepare(statement, units, mine);
    } else if (mine.empty()) {
      law.prepare(statement, mine);
    }
    for (const auto& w : mine.warnings()) problems.warn(w.origin, w.message);
    if (mine.empty()) return std::make_unique<Host>(std::move(law));
    try {
      mine.raise();
    } catch (const InputError& error) {
      problems.add(error);
    }
    return nullptr;
  };
  return item;
}

}  // namespace tribo
