// SPDX-License-Identifier: MIT
/// The values of one particle, block or contact, at one time and over the run, for the live page.
#pragma once

#include "view/scene_cache.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace tribo {

/// What has been picked: a particle by its `id`, a block by its number, or a contact by the numbers of its blocks.
struct Picked {
  enum class Kind { particle, block, contact } kind = Kind::particle;
  std::array<double, 2> numbers{};
};

/// The particle with this index in the file. Throws UsageError if there is none or if the file has no `id`.
Picked particle_at(const Scene& scene, std::size_t index);
/// The contact whose place is nearest to a point, if the scene has contacts.
std::optional<Picked> contact_near(const Scene& scene, const std::array<double, 3>& point);

/// Kind, numbers and place, and all fields with units and components. Null if the scene does not have it.
nlohmann::json values_of(const Scene& scene, const Legend& legend, const Picked& what);

/// The values at the times of the files, or of every n-th if there are many: `times`, and `fields` with names, units
/// and a list for each component. Where it is missing, they are null.
nlohmann::json history_of(const RunFolder& run, const Picked& what);

}  // namespace tribo
