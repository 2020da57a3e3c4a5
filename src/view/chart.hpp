// SPDX-License-Identifier: MIT
/// Curves as SVG.
#pragma once

#include <string>
#include <vector>

namespace tribo {

struct Curve {
  std::string name;
  std::vector<double> values;
};

/// Curves over a common axis as an SVG element, with axes, round ticks and names. Values that are not finite leave
/// gaps.
std::string chart(const std::string& title, const std::string& x_name, const std::vector<double>& x,
                  const std::vector<Curve>& curves);

/// Round numbers from low to high, about `wanted` of them.
std::vector<double> ticks(double low, double high, int wanted);
/// A number with four digits.
std::string short_number(double x);

}  // namespace tribo
