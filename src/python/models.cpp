// SPDX-License-Identifier: MIT
/// Reading, checking and running of models.

#include "model/model.hpp"

#include "base/parallel.hpp"
#include "input/read.hpp"
#include "input/script/script.hpp"
#include "input/script/write_xml.hpp"
#include "python/bindings.hpp"
#include "python/options.hpp"
#include "run/model_record.hpp"
#include "run/preflight.hpp"
#include "run/result_units.hpp"
#include "run/signals.hpp"

#include <map>
#include <optional>
#include <string>

namespace tribo::python {
namespace {

using Values = std::map<std::string, std::string>;

// The accelerations that a Python function of positions and time returns.
ParticleAccelerations accelerations_of(const py::object& function) {
  return [held = Held(function)](int dimension, std::span<const double> positions, double time,
                                 std::span<double> accelerations) {
    const py::gil_scoped_acquire interpreter;
    const auto width = static_cast<py::ssize_t>(dimension);
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(positions.size()) / width, width};
    const py::array_t<double> x(shape, positions.data());
    const py::object given = (*held)(x, time);
    const py::object fitted = py::module_::import("tribo._arrays").attr("fit_acceleration")(given, py::cast(shape));
    const auto a = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(fitted);
    if (!a) throw py::error_already_set();
    std::copy(a.data(), a.data() + a.size(), accelerations.begin());
  };
}

void set_body_force(Model& model, const py::object& function) {
  if (model.only_blocks())
    throw py::value_error("a model of rigid blocks alone has no particles for a body force to act on");
  model.body_force.of_program = accelerations_of(function);
  for (StageSpec& stage : model.stages) {
    auto copy = std::make_shared<Model>(*stage.model);
    copy->body_force.of_program = model.body_force.of_program;
    stage.model = copy;
  }
}

// The model of a run that was stopped, as `tribo resume` takes it: the command file if it has not changed, otherwise
// the copy in the folder.
Model read_stopped(const std::string& folder) {
  const ModelRecord record = read_model_record(folder);
  for (const auto& file : {(folder / record.relative).lexically_normal(), record.file}) {
    if (record.relative.empty() || !std::filesystem::is_regular_file(file)) continue;
    Model model = read_model(file, record.settings);
    if (changes(record, model).empty()) return model;
  }
  return read_model(copy_of_model(folder));
}

std::string run_model(const Model& model, const RunOptions& options) {
  const py::gil_scoped_release released;
  const SignalGuard signals;
  if (tribo::run(model, options) == Outcome::finished) return "finished";
  return SignalGuard::stop() ? "signal" : "wall time";
}

std::string xml_of_text(const std::string& text, const std::string& name, const Values& values) {
  return xml_text(read_statements_text(text, name, values, stderr));
}

std::string xml_of_file(const std::string& file, const Values& values) {
  return xml_text(read_statements(file, values, stderr));
}

}  // namespace

RunOptions options_of(const py::dict& given) {
  RunOptions out;
  const auto has = [&](const char* name) { return given.contains(name) && !given[name].is_none(); };
  out.folder = given["folder"].cast<std::string>();
  out.threads = has("threads") ? given["threads"].cast<int>() : threads();
  out.quiet = has("quiet") && given["quiet"].cast<bool>();
  out.overwrite = has("overwrite") && given["overwrite"].cast<bool>();
  out.resume = has("resume") && given["resume"].cast<bool>();
  out.max_wall = has("max_wall") ? given["max_wall"].cast<double>() : 0.0;
  out.command_line = given["command_line"].cast<std::string>();
  out.from_python = true;
  return out;
}

void add_models(py::module_& module) {
  py::class_<Model>(module, "Model")
      .def_readonly("warnings", &Model::warnings)
      .def_readonly("title", &Model::title)
      .def_readonly("file", &Model::file)
      .def_property_readonly("dimension", &Model::dimension)
      .def_property_readonly("only_blocks", &Model::only_blocks)
      .def_property_readonly("units", &units_of_results)
      .def_property_readonly("end_time", [](const Model& m) { return m.time.end; })
      .def("set_body_force", &set_body_force);
  module.def("read_file", [](const std::string& file, const Values& values) { return read_model(file, values); });
  module.def("read_text", [](const std::string& text, const std::string& name, const Values& values) {
    return read_model_text(text, name, values);
  });
  module.def("read_stopped", &read_stopped, "The model of a run in a folder; a command file that changed is not used");
  module.def("xml_of_file", &xml_of_file);
  module.def("xml_of_text", &xml_of_text);
  module.def("run", [](const Model& model, const py::dict& options) { return run_model(model, options_of(options)); });
  module.def("check", [](const Model& model, std::optional<int> thread_count) {
    const py::gil_scoped_release released;
    const std::string text = preflight(model, thread_count.value_or(threads()));
    return is_script(model.source) ? in_words_of_scripts(text) : text;
  });
  module.def("threads", &threads);
}

}  // namespace tribo::python
