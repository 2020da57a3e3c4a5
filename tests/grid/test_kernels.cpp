// SPDX-License-Identifier: MIT
#include "grid/kernels.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>

using namespace tribo;

namespace {

template <class Kernel>
struct At {
  double w[Kernel::width], g[Kernel::width];
  int base;
  At(double x, double half = 0.25) : base(static_cast<int>(std::floor(x - Kernel::shift))) {
    Kernel::at(x - base, half, w, g);
  }
  double value(int node) const {
    const int k = node - base;
    return k < 0 || k >= Kernel::width ? 0.0 : w[k];
  }
};

}  // namespace

TEMPLATE_TEST_CASE("weights sum to one, reproduce the position, and slopes are their derivative", "[grid]",
                   LinearKernel, GimpKernel, QuadraticKernel, CubicKernel) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(10, 12), size(0.05, 0.5);
  for (int n = 0; n < 100000; ++n) {
    const double x = position(random), half = size(random);
    const At<TestType> at(x, half);
    double one = 0, zero = 0, mean = 0, gradient = 0;
    for (int k = 0; k < TestType::width; ++k) {
      one += at.w[k], zero += at.g[k];
      mean += at.w[k] * (at.base + k), gradient += at.g[k] * (at.base + k);
      REQUIRE(at.w[k] > -1e-16);
    }
    REQUIRE(std::abs(one - 1) < 1e-14);
    REQUIRE(std::abs(zero) < 1e-13);
    REQUIRE(std::abs(mean - x) < 1e-13);
    REQUIRE(std::abs(gradient - 1) < 1e-13);
    const double e = 1e-6;
    const At<TestType> up(x + e, half), down(x - e, half);
    if (up.base == at.base && down.base == at.base)
      for (int k = 0; k < TestType::width; ++k)
        REQUIRE(std::abs((up.w[k] - down.w[k]) / (2 * e) - at.g[k]) < 1e-4);  // kinks of GIMP: slope/2 e / l
  }
}

TEST_CASE("kernels have their published values", "[grid]") {
  CHECK(At<GimpKernel>(10.0).value(10) == Approx(0.875).epsilon(1e-15));
  CHECK(At<GimpKernel>(10.5).value(10) == Approx(0.5).epsilon(1e-15));
  CHECK(At<GimpKernel>(11.0).value(10) == Approx(0.0625).epsilon(1e-15));
  CHECK(At<QuadraticKernel>(10.0).value(10) == Approx(0.75).epsilon(1e-15));
  CHECK(At<QuadraticKernel>(10.5).value(10) == Approx(0.5).epsilon(1e-15));
  CHECK(At<QuadraticKernel>(11.0).value(10) == Approx(0.125).epsilon(1e-15));
  CHECK(At<CubicKernel>(10.0).value(10) == Approx(2.0 / 3).epsilon(1e-15));
  CHECK(At<CubicKernel>(10.5).value(10) == Approx(23.0 / 48).epsilon(1e-15));
  CHECK(At<CubicKernel>(11.0).value(10) == Approx(1.0 / 6).epsilon(1e-15));
}
