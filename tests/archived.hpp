// SPDX-License-Identifier: MIT
/// The state of objects in memory, for comparisons to the bit.
#pragma once

#include "base/archive.hpp"

#include <bit>
#include <map>
#include <string>
#include <vector>

namespace tribo::test {

/// Entries by name. Doubles are kept as bits, so that NaN equals itself and 0 differs from -0.
using ArchivedState = std::map<std::string, std::vector<std::int64_t>>;

class MemoryArchive final : public NamedArchive {
 public:
  MemoryArchive(ArchivedState& state, bool reading) : NamedArchive(reading), state_(state) {}

  void doubles(std::string_view name, std::span<double> values) override {
    auto& saved = entry(name, values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (reading())
        values[k] = std::bit_cast<double>(saved[k]);
      else
        saved[k] = std::bit_cast<std::int64_t>(values[k]);
    }
  }
  void integers(std::string_view name, std::span<std::int64_t> values) override {
    auto& saved = entry(name, values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      (reading() ? values[k] : saved[k]) = reading() ? saved[k] : values[k];
  }

 private:
  std::vector<std::int64_t>& entry(std::string_view name, std::size_t size) {
    if (!reading()) return state_[full_name(name)] = std::vector<std::int64_t>(size);
    const auto found = state_.find(full_name(name));
    if (found == state_.end() || found->second.size() != size) throw FileError("'" + full_name(name) + "' is wrong");
    return found->second;
  }
  ArchivedState& state_;
};

template <class T>
ArchivedState archived(T& object) {
  ArchivedState state;
  MemoryArchive a(state, false);
  a("object", object);
  return state;
}

template <class T>
void restore(ArchivedState state, T& object) {
  MemoryArchive a(state, true);
  a("object", object);
}

/// The names of the entries that differ.
inline std::vector<std::string> differences(const ArchivedState& a, const ArchivedState& b) {
  std::vector<std::string> out;
  for (const auto& [name, values] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != values) out.push_back(name);
  for (const auto& [name, values] : b)
    if (a.count(name) == 0) out.push_back(name);
  return out;
}

}  // namespace tribo::test
