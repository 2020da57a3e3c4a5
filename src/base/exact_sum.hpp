// SPDX-License-Identifier: MIT
/// Sums of floating-point numbers that do not depend on the order of their terms.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace tribo {

/// A sum without rounding: a fixed-point number that covers the range of all doubles, in parts of 32 bits. Only its
/// conversion to a double rounds, so that the result is the same for every order and every grouping of the terms.
/// Kulisch, Computer Arithmetic and Validity (2013), chapter 8; the delayed carries are those of Neal, Fast exact
/// summation using small and large superaccumulators (arXiv:1505.05571).
class ExactSum {
 public:
  static constexpr std::size_t part_count = 66;  ///< 2046 shifts of 53 bits, in steps of 32

  /// Adds a term. Once an infinite term or one that is not a number was added, the value is not finite.
  void add(double term) {
    constexpr int fraction_bits = 52;
    const auto bits = std::bit_cast<std::uint64_t>(term);
    const auto exponent = static_cast<int>(bits >> fraction_bits & 0x7ff);
    std::uint64_t fraction = bits & ((std::uint64_t{1} << fraction_bits) - 1);
    if (exponent == 0x7ff) {
      not_finite_ += term;
      return;
    }
    if (exponent > 0) fraction |= std::uint64_t{1} << fraction_bits;
    if (fraction == 0) return;
    const int shift = std::max(0, exponent - 1);
    const auto lowest = static_cast<std::size_t>(shift / 32);
    const int within = shift % 32;
    const auto low = static_cast<std::int64_t>(fraction << within & mask);
    const auto middle = static_cast<std::int64_t>(fraction >> (32 - within) & mask);
    const auto high = static_cast<std::int64_t>(fraction >> 32 >> (32 - within));
    const std::int64_t sign = bits >> 63 ? -1 : 1;
    parts_[lowest] += sign * low, parts_[lowest + 1] += sign * middle, parts_[lowest + 2] += sign * high;
    begin_ = std::min(begin_, lowest), end_ = std::max(end_, lowest + 3);
    if (++pending_ == most_pending) carry();
  }
  /// Adds another sum.
  void add(const ExactSum& other) {
    ExactSum carried = other;
    carried.carry(), carry();
    for (std::size_t k = carried.begin_; k < carried.end_; ++k) parts_[k] += carried.parts_[k];
    begin_ = std::min(begin_, carried.begin_), end_ = std::max(end_, carried.end_);
    pending_ = 2;
    not_finite_ += carried.not_finite_;
  }

  /// The sum as a double, within one unit of its last digit.
  double value() const {
    if (not_finite_ != 0.0) return not_finite_;
    ExactSum carried = *this;
    carried.carry();
    // The uppermost part has the sign of the sum; all others are positive.
    const bool negative = carried.end_ > carried.begin_ && carried.parts_[carried.end_ - 1] < 0;
    if (negative) {
      for (std::size_t k = carried.begin_; k < carried.end_; ++k) carried.parts_[k] = -carried.parts_[k];
      carried.carry();
    }
    std::size_t top = carried.end_;
    while (top > carried.begin_ && carried.parts_[top - 1] == 0) --top;
    constexpr std::size_t significant = 4;  // parts that a double can show
    double sum = 0.0;
    for (std::size_t k = std::max(carried.begin_, top - std::min(top, significant)); k < top; ++k)
      sum += std::ldexp(static_cast<double>(carried.parts_[k]), static_cast<int>(32 * k) - 1074);
    return negative ? -sum : sum;
  }

  /// Carries what exceeds 32 bits of a part to the next one, so that the parts of many sums can be added one by one.
  void carry() {
    pending_ = 0;
    for (std::size_t k = begin_; k < end_; ++k) {
      const bool top = k + 1 == end_;
      if (top && std::abs(parts_[k]) <= mask) return;
      const std::int64_t over = parts_[k] >> 32;
      if (over == 0) continue;
      parts_[k] -= over * (mask + 1), parts_[k + 1] += over;
      if (top) ++end_;
    }
  }
  /// The parts from the lowest one, each times 2^(32 k - 1074). Those that are changed must then be read by include().
  std::span<std::int64_t, part_count> parts() { return parts_; }
  /// To be called after all parts may have changed, with the sum of the terms that are not finite.
  void include(double not_finite) { begin_ = 0, end_ = part_count, pending_ = 2, not_finite_ = not_finite; }
  double not_finite() const { return not_finite_; }

 private:
  static constexpr std::int64_t mask = 0xffffffff;
  static constexpr std::int32_t most_pending = 1 << 29;  // terms of 32 bits that 63 bits can hold, with a reserve

  std::array<std::int64_t, part_count> parts_{};
  std::size_t begin_ = part_count, end_ = 0;  // the parts in use
  std::int32_t pending_ = 0;                  // terms since the last carry
  double not_finite_ = 0.0;
};

}  // namespace tribo
