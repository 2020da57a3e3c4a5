// SPDX-License-Identifier: MIT
/// The module tribo._core: what the Python package tribo is built on.

#include "output/provenance.hpp"
#include "python/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  namespace python = tribo::python;
  module.doc() = "The solver as seen by the package tribo, which documents it; not meant to be used directly.";
  module.def("version", &tribo::version_text);
  python::add_errors(module);
  python::add_manual(module);
  python::add_models(module);
  python::add_drive(module);
  python::add_simulation(module);
  python::add_material_laws(module);
  python::add_contact_laws(module);
}
