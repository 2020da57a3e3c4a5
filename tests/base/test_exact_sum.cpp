// SPDX-License-Identifier: MIT
/// Sums without rounding.

#include "base/exact_sum.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

using namespace tribo;

namespace {

std::vector<double> random_terms(std::size_t count) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> fraction(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 300);
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(std::ldexp(fraction(random), exponent(random)));
  return out;
}

double sum_of_terms(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

}  // namespace

TEST_CASE("an exact sum holds a single term without change", "[base]") {
  for (const double x : {0.0, 1.0, -1.0, 0.1, -1e300, 1e-310, std::numeric_limits<double>::denorm_min(),
                         std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), 3.0e-5})
    CHECK(sum_of_terms({x}) == x);
}

TEST_CASE("an exact sum keeps what rounding would lose", "[base]") {
  CHECK(sum_of_terms({1e100, 1.0, -1e100}) == 1.0);
  CHECK(sum_of_terms({1.0, 1e-300, -1.0}) == 1e-300);
  CHECK(sum_of_terms({-1e-300, 1.0, -1.0}) == -1e-300);
  CHECK(sum_of_terms({0.1, 0.2, -0.1, -0.2}) == 0.0);
}

TEST_CASE("an exact sum does not depend on the order and the grouping of its terms", "[base]") {
  auto terms = random_terms(20000);
  const double expected = sum_of_terms(terms);
  std::mt19937 random(3);
  for (int trial = 0; trial < 5; ++trial) {
    std::shuffle(terms.begin(), terms.end(), random);
    CHECK(sum_of_terms(terms) == expected);
    ExactSum first, second;
    for (std::size_t k = 0; k < terms.size(); ++k) (k % 3 == 0 ? first : second).add(terms[k]);
    first.add(second);
    CHECK(first.value() == expected);
  }
}

TEST_CASE("an exact sum of numbers of equal size is that of long double within one digit", "[base]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> fraction(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ExactSum sum;
    long double expected = 0;
    for (int k = 0; k < 50; ++k) {
      const double x = fraction(random);
      sum.add(x), expected += x;
    }
    CHECK(std::abs(sum.value() - static_cast<double>(expected)) < 1e-15);
  }
}

TEST_CASE("an exact sum with an infinite term or one that is not a number is not finite", "[base]") {
  CHECK(sum_of_terms({1.0, std::numeric_limits<double>::infinity()}) == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(sum_of_terms({1.0, std::numeric_limits<double>::quiet_NaN(), 2.0})));
}
