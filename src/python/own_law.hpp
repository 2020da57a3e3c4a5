// SPDX-License-Identifier: MIT
/// What material and contact laws written in Python have in common.
#pragma once

#include "base/catalogue.hpp"
#include "python/bindings.hpp"

#include <string>
#include <vector>

namespace tribo::python {

/// The dimension with this generic name, as in the manual: `stress`, `1/time`; `-` or nothing: none. Throws
/// UsageError.
Dimension dimension_of(const std::string& name);

/// From rows (name, dimension, default or None, lowest, highest, whether open below and above, meaning).
std::vector<ParameterInfo> parameters_of(const py::list& rows);

/// The catalogue entry of a law of Python. `make_law(**parameters)` returns its object, of which `Host` is made,
/// with the name of the law.
template <class Base, class Host>
typename Catalogue<Base>::Item own_law(const std::string& name, const std::string& summary, const py::list& rows,
                                       const py::object& make_law) {
  typename Catalogue<Base>::Item item;
  item.name = name, item.summary = summary, item.parameters = parameters_of(rows);
  item.make = [name, parameters = item.parameters, make = Held(make_law)](
                  const Statement& statement, const std::vector<std::string>& handled_elsewhere, const Units& units,
                  Problems& problems) -> std::unique_ptr<Base> {
    Problems mine;
    const auto values = read_parameters(statement, parameters, handled_elsewhere, units, mine);
    if (mine.empty()) {
      const py::gil_scoped_acquire interpreter;
      py::dict given;
      for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k]) given[py::str(parameters[k].name)] = *values[k];
      try {
        return std::make_unique<Host>(Held((*make)(**given)), name);
      } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError)) throw;
        mine.add(statement.origin, py::str(error.value()));
      }
    }
    problems.add(mine);
    return nullptr;
  };
  return item;
}

}  // namespace tribo::python
