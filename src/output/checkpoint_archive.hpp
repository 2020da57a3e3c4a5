// SPDX-License-Identifier: MIT
/// Archives that save to a checkpoint and restore from one.
#pragma once

#include "base/archive.hpp"
#include "output/checkpoint.hpp"

#include <set>

namespace tribo {

class SavingArchive final : public NamedArchive {
 public:
  explicit SavingArchive(CheckpointWriter& to) : NamedArchive(false), to_(to) {}

  void doubles(std::string_view name, std::span<double> values) override { to_.put(full_name(name), values); }
  void integers(std::string_view name, std::span<std::int64_t> values) override { to_.put(full_name(name), values); }

 private:
  CheckpointWriter& to_;
};

/// Throws FileError that names the entry if one is missing or has another size.
class RestoringArchive final : public NamedArchive {
 public:
  explicit RestoringArchive(const Checkpoint& from) : NamedArchive(true), from_(from) {}

  void doubles(std::string_view name, std::span<double> values) override;
  void integers(std::string_view name, std::span<std::int64_t> values) override;
  /// Throws FileError with the name of an entry of the checkpoint that nothing asked for.
  void finish() const;

 private:
  template <class T>
  void take(std::string_view name, std::vector<T> saved, std::span<T> values);

  const Checkpoint& from_;
  std::set<std::string> visited_;
};

}  // namespace tribo
