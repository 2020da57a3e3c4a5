// SPDX-License-Identifier: MIT
/// The manual and the tables of keywords.

#include "input/manual.hpp"

#include "input/script/commands.hpp"
#include "python/bindings.hpp"

namespace tribo::python {
namespace {

py::list entries() {
  py::list out;
  for (const ManualEntry& e : manual()) {
    py::list rows;
    for (const ManualRow& r : e.rows) rows.append(py::make_tuple(r.name, r.kind, r.meaning));
    out.append(py::make_tuple(e.kind, e.name, e.usage, e.meaning, rows));
  }
  return out;
}

py::list command_table() {
  py::list out;
  for (const script::CommandInfo& c : script::commands())
    out.append(py::make_tuple(std::string(c.name), c.least, c.most, std::string(c.arguments), std::string(c.meaning)));
  return out;
}

}  // namespace

void add_manual(py::module_& module) {
  module.def("manual", &entries, "(kind, name, usage, meaning, rows) of every entry of the manual");
  module.def("manual_text", [](const std::string& name) { return manual_text(name); });
  module.def("manual_list", &manual_list);
  module.def("commands", &command_table, "(name, least, most, arguments, meaning) of every command of scripts");
}

}  // namespace tribo::python
