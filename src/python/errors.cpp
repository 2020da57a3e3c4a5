// SPDX-License-Identifier: MIT
/// Exceptions of Tribo as exceptions of the package, with the texts of the program.

#include "base/error.hpp"

#include "python/bindings.hpp"
#include "run/result_folder.hpp"
#include "run/signals.hpp"

#include <exception>
#include <filesystem>

namespace tribo::python {
namespace {

void raise(const char* type, const py::args& arguments) {
  const py::object made = py::module_::import("tribo.errors").attr(type)(*arguments);
  PyErr_SetObject(py::type::handle_of(made).ptr(), made.ptr());
}

py::list problems_of(const InputError& error) {
  py::list out;
  for (const Problem& p : error.problems()) {
    const auto file = p.origin.file ? py::cast(*p.origin.file) : py::none();
    out.append(py::make_tuple(file, p.origin.line, p.origin.column, p.message));
  }
  return out;
}

void translate(std::exception_ptr caught) {
  try {
    if (caught) std::rethrow_exception(std::move(caught));
  } catch (const InputError& error) {
    raise("InputError", py::make_tuple(error.what(), problems_of(error)));
  } catch (const SimulationError& error) {
    raise("NumericalError", py::make_tuple(error.what()));
  } catch (const UsedFolderError& error) {
    const std::string folder = "'" + error.folder() + "'";
    raise("OutputError", py::make_tuple(folder +
                                        " already holds a run; overwrite=True replaces it, folder=... names another "
                                        "folder, and tribo.resume(" +
                                        folder + ") continues a run that was stopped"));
  } catch (const FileError& error) {
    raise("OutputError", py::make_tuple(error.what()));
  } catch (const UsageError& error) {
    raise("UsageError", py::make_tuple(error.what()));
  } catch (const std::filesystem::filesystem_error& error) {
    raise("OutputError", py::make_tuple("'" + error.path1().string() + "': " + error.code().message()));
  } catch (const StopRequest&) {
    PyErr_SetString(PyExc_KeyboardInterrupt, "stopped; nothing was written");
  }
}

}  // namespace

void add_errors(py::module_&) { py::register_exception_translator(translate); }

}  // namespace tribo::python
