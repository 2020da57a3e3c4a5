// SPDX-License-Identifier: MIT
/// Runs that Python advances, and what their particles are like in between.

#include "run/simulation.hpp"

#include "base/error.hpp"
#include "model/output_fields.hpp"
#include "python/fields.hpp"
#include "python/lent_columns.hpp"
#include "python/options.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/staged_run.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace tribo::python {
namespace {

// Calls f(run) with the run on a grid, of either dimension, at its present stage.
template <class F>
auto with_grid(SteppedModel& stepped, F&& f) {
  if (auto* run = dynamic_cast<GridRun<2>*>(&stepped)) return f(*run);
  if (auto* run = dynamic_cast<GridRun<3>*>(&stepped)) return f(*run);
  if (auto* run = dynamic_cast<StagedRun<GridRun<2>>*>(&stepped)) return f(run->present());
  if (auto* run = dynamic_cast<StagedRun<GridRun<3>>*>(&stepped)) return f(run->present());
  throw py::value_error("a model of rigid blocks alone has no particles");
}

// The bodies by their number: the deformable ones, then the rigid ones.
template <int Dim>
Body<Dim>& body_of(GridRun<Dim>& run, std::size_t number) {
  auto &bodies = run.system().bodies, &rigids = run.system().rigids;
  return number < bodies.size() ? bodies[number] : rigids.at(number - bodies.size());
}

const char* word(StepwiseRun::Pause pause) {
  const char* words[] = {"due", "end", "signal", "wall time"};
  return words[static_cast<std::size_t>(pause)];
}

// What a field needs to have a meaning in this run.
void must_be_kept(const Model& model, const std::string& name) {
  const ParticleField* field = find_particle_field(name);
  std::vector<std::string> known;
  for (const auto& f : particle_fields()) known.emplace_back(f.name);
  if (!field) throw py::key_error("there is no field '" + name + "'" + did_you_mean(name, known));
  const auto& wanted = model.output.particle_fields;
  const auto& written = wanted.empty() ? standard_particle_fields() : wanted;
  const bool is_written = std::find(written.begin(), written.end(), field->name) != written.end();
  const bool always = field->needs == ParticleField::Needs::nothing && field->name != "cell_crossings";
  if (!is_written && !always)
    throw py::key_error("the run does not keep what '" + name + "' needs; name it among the fields of the output");
}

class Simulation {
 public:
  Simulation(Model model, const RunOptions& options) {
    const py::gil_scoped_release released;
    run_ = open_run(std::move(model), options);
  }

  std::string advance(std::int64_t steps) {
    take_back_columns();
    const py::gil_scoped_release released;
    return word(run_->advance(steps));
  }
  void stop(const std::string& reason) {
    take_back_columns();
    const py::gil_scoped_release released;
    run_->stop(reason);
  }
  void flush() {
    const py::gil_scoped_release released;
    run_->flush();
  }
  double time() const { return run_->stepped().time(); }
  std::int64_t step() const { return run_->stepped().step(); }
  double step_size() const { return run_->stepped().step_size(); }
  const Model& model() const { return run_->model(); }

  // (name, number of particles, whether rigid) of each body.
  py::list bodies() {
    return with_grid(run_->stepped(), [](auto& run) {
      py::list out;
      for (auto* list : {&run.system().bodies, &run.system().rigids})
        for (auto& body : *list)
          out.append(py::make_tuple(body.name, body.particles.size(), list == &run.system().rigids));
      return out;
    });
  }
  std::vector<std::string> columns(std::size_t body) {
    return with_grid(run_->stepped(), [&](auto& run) {
      std::vector<std::string> out;
      for (const auto& column : body_of(run, body).particles.columns()) out.push_back(column.name);
      return out;
    });
  }
  std::vector<std::string> histories(std::size_t body) {
    return with_grid(run_->stepped(), [&](auto& run) {
      std::vector<std::string> out;
      for (const auto& variable : body_of(run, body).law->history()) out.push_back(variable.name);
      return out;
    });
  }
  py::array column(std::size_t body, std::size_t number, bool writable) {
    return with_grid(run_->stepped(), [&](auto& run) {
      auto& particles = body_of(run, body).particles;
      return lent_.lend(particles.columns().at(number).data, particles.size(), writable, run_);
    });
  }
  py::array ids(std::size_t body) {
    return with_grid(run_->stepped(), [&](auto& run) {
      const auto& particles = body_of(run, body).particles;
      return py::array(py::array_t<std::int64_t>(std::vector{particles.size()}, particles.id.data()));
    });
  }
  // Fields of all particles, by name; with the fields of the files if there are no names.
  py::dict fields(std::vector<std::string> names) {
    for (const std::string& name : names) must_be_kept(model(), name);
    if (names.empty()) names = model().output.particle_fields;
    if (names.empty()) names = standard_particle_fields();
    return with_grid(run_->stepped(), [&](auto& run) {
      const auto all = run.particle_fields(names);
      py::dict out;
      out["position"] = array_of(all->positions(), all->count());
      for (const OutputField& field : all->fields()) out[py::str(field.name)] = array_of(field, all->count());
      return out;
    });
  }

 private:
  void take_back_columns() {
    if (!lent_.take_back()) return;
    with_grid(run_->stepped(), [](auto& run) {
      for (auto& body : run.system().bodies) body.refresh();
    });
  }

  std::shared_ptr<StepwiseRun> run_;
  LentColumns lent_;
};

}  // namespace

void add_simulation(py::module_& module) {
  py::class_<Simulation>(module, "Simulation")
      .def(py::init([](const Model& model, const py::dict& options) {
        return std::make_unique<Simulation>(model, options_of(options));
      }))
      .def("advance", &Simulation::advance)
      .def("stop", &Simulation::stop)
      .def("flush", &Simulation::flush)
      .def_property_readonly("time", &Simulation::time)
      .def_property_readonly("step", &Simulation::step)
      .def_property_readonly("step_size", &Simulation::step_size)
      .def("bodies", &Simulation::bodies)
      .def("columns", &Simulation::columns)
      .def("histories", &Simulation::histories)
      .def("column", &Simulation::column)
      .def("ids", &Simulation::ids)
      .def("fields", &Simulation::fields);
}

}  // namespace tribo::python
