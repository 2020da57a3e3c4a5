// SPDX-License-Identifier: MIT
#include "run/body_order.hpp"

#include <algorithm>

namespace tribo {

BodyOrder order_by_body(std::span<const std::int64_t> numbers,
                        const std::vector<std::pair<std::int64_t, std::int64_t>>& bodies) {
  BodyOrder out{std::vector<std::uint32_t>(numbers.size()), std::vector<std::size_t>(bodies.size() + 1, 0)};
  std::vector<std::uint32_t> body_of(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::int64_t number = numbers[i];
    const auto after =
        std::partition_point(bodies.begin(), bodies.end(), [&](const auto& b) { return b.first <= number; });
    const bool inside = after != bodies.begin() && number <= std::prev(after)->second;
    const auto body = inside ? static_cast<std::size_t>(after - bodies.begin()) - 1 : bodies.size();
    body_of[i] = static_cast<std::uint32_t>(body);
    ++out.counts[body];
  }
  std::vector<std::size_t> next(out.counts.size(), 0);
  for (std::size_t b = 1; b < next.size(); ++b) next[b] = next[b - 1] + out.counts[b - 1];
  for (std::size_t i = 0; i < numbers.size(); ++i) out.particles[next[body_of[i]]++] = static_cast<std::uint32_t>(i);
  return out;
}

}  // namespace tribo
