// SPDX-License-Identifier: MIT
/// Numbers that are neither infinite nor NaN.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace tribo {

/// Whether all numbers are finite; without a branch per number, so that it takes no longer than to read them.
inline bool all_finite(std::span<const double> values) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000U;
  std::uint64_t wrong = 0;
  for (const double& x : values)
    wrong |= static_cast<std::uint64_t>((std::bit_cast<std::uint64_t>(x) & exponent) == exponent);
  return wrong == 0;
}
inline bool all_finite(std::span<const float> values) {
  constexpr std::uint32_t exponent = 0x7f800000U;
  std::uint32_t wrong = 0;
  for (const float& x : values)
    wrong |= static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(x) & exponent) == exponent);
  return wrong == 0;
}

}  // namespace tribo
