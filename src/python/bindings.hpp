// SPDX-License-Identifier: MIT
/// What the parts of the Python module share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

namespace tribo::python {

namespace py = pybind11;

/// A Python object that C++ keeps. It may be copied, called and released by threads that do not hold the interpreter.
class Held {
 public:
  explicit Held(const py::object& object)
      : object_(new py::object(object), [](py::object* held) {
          if (Py_IsInitialized() == 0) return;  // at the end of the program the interpreter has released it already
          const py::gil_scoped_acquire interpreter;
          delete held;
        }) {}
  /// To be used with the interpreter held.
  const py::object& operator*() const { return *object_; }

 private:
  std::shared_ptr<py::object> object_;
};

// Each adds the classes and functions of one subject to the module.
void add_errors(py::module_& module);
void add_manual(py::module_& module);
void add_models(py::module_& module);
void add_drive(py::module_& module);
void add_simulation(py::module_& module);
void add_material_laws(py::module_& module);
void add_contact_laws(py::module_& module);

}  // namespace tribo::python
