// SPDX-License-Identifier: MIT
#include "run/simulation.hpp"

#include "base/parallel.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/result_folder.hpp"

namespace tribo {
namespace {

// The model is built before the folder is touched, so that a wrong command file leaves old results as they are.
template <class Stepped>
Outcome run(const Model& model, const RunOptions& options, const std::vector<const char*>& parts) {
  Stepped stepped(model);
  if (options.resume) {
    require_checkpoint(options.folder);
  } else {
    check_folder(options);
    prepare_folder(options.folder, parts);
  }
  return run_to_end(model, stepped, options);
}

template <int Dim>
Settlement settle(const Model& model, int thread_count) {
  GridRun<Dim> run(model);
  run.choose_threads(thread_count);
  Settlement out;
  run.start();
  const auto advance_to = [&](double time) {
    while (!run.has_reached(time)) run.advance();
  };
  try {
    advance_to(0.75 * model.time.end);
    out.late = run.largest_displacement();
    advance_to(model.time.end);
    out.at_end = run.largest_displacement();
  } catch (const SimulationError& error) {
    out.failure = error.what();
  }
  return out;
}

}  // namespace

std::map<std::string, std::string> unit_facts(const Model& model) {
  std::map<std::string, std::string> out;
  using D = Dimension;
  for (const auto& [name, dimension] :
       {std::pair("length", D::length), std::pair("time", D::time), std::pair("velocity", D::velocity),
        std::pair("stress", D::stress), std::pair("force", D::force), std::pair("mass", D::mass)})
    out["unit of " + std::string(name)] = model.units.name(dimension);
  out["units"] = model.units.name(D::length) + ", " + model.units.name(D::mass) + ", " + model.units.name(D::time);
  return out;
}

void check_folder(const RunOptions& options) {
  if (!options.overwrite) refuse_used_folder(options.folder);
}

Outcome run(const Model& model, const RunOptions& options) {
  set_threads(options.threads);
  if (model.only_blocks()) return run<BlockRun>(model, options, {"blocks", "contacts"});
  std::vector<const char*> parts{"particles", "grid", "cracks", "joints"};
  if (model.blocks) parts.insert(parts.end(), {"blocks", "contacts"});
  return model.dimension() == 2 ? run<GridRun<2>>(model, options, parts) : run<GridRun<3>>(model, options, parts);
}

Settlement settle(const Model& model, int thread_count) {
  return model.dimension() == 2 ? settle<2>(model, thread_count) : settle<3>(model, thread_count);
}

}  // namespace tribo
