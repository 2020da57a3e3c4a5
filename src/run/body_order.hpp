// SPDX-License-Identifier: MIT
/// The particles of a material, body by body.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tribo {

/// The order in which the particles of a material stand in a file: one body after the other, and last those that came
/// during the run. Within a body they keep the order in which they are stored.
struct BodyOrder {
  std::vector<std::uint32_t> particles;  ///< index of each particle in the order of the file
  std::vector<std::size_t> counts;       ///< particles of each body, then of those that came later
};

/// `numbers`: of the particles as they are stored; `bodies`: the first and the last number of each body's particles at
/// the start, in increasing order.
BodyOrder order_by_body(std::span<const std::int64_t> numbers,
                        const std::vector<std::pair<std::int64_t, std::int64_t>>& bodies);

}  // namespace tribo
