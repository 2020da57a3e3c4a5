// SPDX-License-Identifier: MIT
#include "base/ranks.hpp"

#include <algorithm>
#include <limits>

namespace tribo {
namespace {

const Ranks& single() {
  static const Ranks one;
  return one;
}

const Ranks* present = nullptr;  // null: a single one

}  // namespace

const Ranks& ranks() { return present ? *present : single(); }
void set_ranks(const Ranks* all) { present = all; }

AloneScope::AloneScope() : before_(present) { set_ranks(nullptr); }

void Ranks::exchange(std::span<const Message>, std::span<Message>) const {}

void add_over_ranks(std::span<ExactSum> sums) {
  if (ranks().count() == 1) return;
  std::vector<std::int64_t> parts;
  std::vector<double> not_finite;
  for (ExactSum& sum : sums) {
    sum.carry();
    parts.insert(parts.end(), sum.parts().begin(), sum.parts().end());
    not_finite.push_back(sum.not_finite() == 0.0 ? 0.0 : 1.0);
  }
  ranks().add(parts), ranks().largest(not_finite);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    std::copy_n(parts.begin() + static_cast<std::ptrdiff_t>(k * ExactSum::part_count), ExactSum::part_count,
                sums[k].parts().begin());
    sums[k].include(not_finite[k] > 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0);
  }
}

double largest_of_ranks(double value) {
  ranks().largest({&value, 1});
  return value;
}

bool any_rank(bool condition) { return largest_of_ranks(condition ? 1.0 : 0.0) > 0; }

}  // namespace tribo
