// SPDX-License-Identifier: MIT
/// A single law along a path.

#include "drive/drive.hpp"

#include "input/read.hpp"
#include "python/bindings.hpp"

#include <map>
#include <string>

namespace tribo::python {
namespace {

using Values = std::map<std::string, std::string>;

// The names of the columns, and the rows as an array.
py::tuple table_of(const Drive& what) {
  const Table table = std::visit([](const auto& one) { return drive(one); }, what);
  (void)table.text();  // throws if a number is not finite, with its place
  const std::vector<std::size_t> shape{table.rows.size(), table.names.size()};
  py::array_t<double> numbers(shape);
  double* to = numbers.mutable_data();
  for (const auto& row : table.rows) to = std::copy(row.begin(), row.end(), to);
  return py::make_tuple(table.names, numbers);
}

}  // namespace

void add_drive(py::module_& module) {
  module.def("drive_file",
             [](const std::string& file, const Values& values) { return table_of(read_drive(file, values)); });
  module.def("drive_text", [](const std::string& text, const std::string& name, const Values& values) {
    return table_of(read_drive_text(text, name, values));
  });
}

}  // namespace tribo::python
