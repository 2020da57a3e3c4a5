// SPDX-License-Identifier: MIT
#include "output/checkpoint_archive.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <class T>
void RestoringArchive::take(std::string_view name, std::vector<T> saved, std::span<T> values) {
  if (saved.size() != values.size())
    throw FileError("the entry '" + full_name(name) + "' of the checkpoint has " + std::to_string(saved.size()) +
                    " numbers, not " + std::to_string(values.size()) + "; it belongs to another command file");
  std::copy(saved.begin(), saved.end(), values.begin());
  visited_.insert(full_name(name));
}

void RestoringArchive::doubles(std::string_view name, std::span<double> values) {
  take(name, from_.doubles(full_name(name)), values);
  // Nothing else is ever saved.
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    refuse_checkpoint("'" + full_name(name) + "' has a number that is not finite");
}

void RestoringArchive::integers(std::string_view name, std::span<std::int64_t> values) {
  take(name, from_.integers(full_name(name)), values);
  // The size of a list is believed only if the file is large enough for it.
  if (!name.ends_with(".size") && !name.ends_with(".count") && name != "points") return;
  for (const std::int64_t size : values)
    if (size < 0 || static_cast<std::size_t>(size) > from_.bytes())
      throw FileError("the entry '" + full_name(name) + "' of the checkpoint is " + std::to_string(size) +
                      ", but the file is not large enough for such a list");
}

void RestoringArchive::finish() const {
  for (const auto& name : from_.names())
    if (visited_.count(name) == 0)
      throw FileError("the entry '" + name + "' of the checkpoint is unknown; it belongs to another command file");
}

}  // namespace tribo
