// SPDX-License-Identifier: MIT
#include "python/own_law.hpp"

#include "base/error.hpp"

namespace tribo::python {

Dimension dimension_of(const std::string& name) {
  if (name.empty() || name == "-") return Dimension::none;
  std::vector<std::string> known;
  for (int k = 0; k <= static_cast<int>(Dimension::angle); ++k) {
    known.emplace_back(dimension_name(static_cast<Dimension>(k)));
    if (known.back() == name) return static_cast<Dimension>(k);
  }
  throw UsageError("there is no dimension '" + name + "'" + did_you_mean(name, known) + "; valid: " + join(known));
}

std::vector<ParameterInfo> parameters_of(const py::list& rows) {
  std::vector<ParameterInfo> out;
  for (const auto item : rows) {
    const auto r = item.cast<py::tuple>();
    ParameterInfo info;
    info.name = r[0].cast<std::string>();
    info.dimension = dimension_of(r[1].cast<std::string>());
    info.fallback = r[2].cast<std::optional<double>>();
    info.range = {r[3].cast<double>(), r[4].cast<double>(), r[5].cast<bool>(), r[6].cast<bool>()};
    info.meaning = r[7].cast<std::string>();
    out.push_back(std::move(info));
  }
  return out;
}

}  // namespace tribo::python
