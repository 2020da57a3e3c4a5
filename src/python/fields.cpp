// SPDX-License-Identifier: MIT
#include "python/fields.hpp"

#include <vector>

namespace tribo::python {
namespace {

std::vector<std::size_t> shape_of(std::size_t count, std::size_t width) {
  return width == 1 ? std::vector<std::size_t>{count} : std::vector<std::size_t>{count, width};
}

}  // namespace

py::array array_of(const OutputRows& rows, std::size_t count) {
  const auto shape = shape_of(count, static_cast<std::size_t>(rows.width));
  if (rows.floats) return py::array_t<float>(shape, rows.floats);
  return py::array_t<double>(shape, rows.doubles);
}

py::array array_of(const OutputField& field, std::size_t count) {
  if (field.integers) return py::array_t<std::int64_t>(shape_of(count, 1), field.integers);
  if (field.components.empty()) return array_of(field.rows, count);
  const std::size_t width = field.components.size();
  py::array_t<double> out(shape_of(count, width));
  double* to = out.mutable_data();
  for (std::size_t i = 0; i < count; ++i)
    for (const double* component : field.components) *to++ = component ? component[i] : 0.0;
  return out;
}

}  // namespace tribo::python
