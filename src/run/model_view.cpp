// SPDX-License-Identifier: MIT
#include "run/model_view.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "model/output_fields.hpp"
#include "output/atomic_file.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/model_layers.hpp"
#include "run/run_record.hpp"

namespace tribo {
namespace {

template <class Run, class Layers>
void write(const Model& model, const std::filesystem::path& folder, const std::string& command_line, int threads,
           Layers layers) {
  std::optional<Run> run;
  with_memory_for("this model", model.only_blocks() ? model.blocks->origin : model.grid.origin, [&] {
    run.emplace(model);
    run->choose_threads(threads);
    run->start();
  });
  OutputQueue queue;
  run->open_results(folder, std::nullopt, queue);
  run->write_files(0);
  queue.drain();
  write_atomically(folder / "layers.json", layers(*run));
  Provenance record(folder / "provenance.json", command_line, model.file, threads, facts_of(model, *run, ""));
  record.set_legend(legend_of(model, *run));
  record.write("model", "", 0.0, 0);
}

// What is known before a run; the model of the run may write other fields.
Model with_initial_fields(const Model& model) {
  Model out = model;
  out.output.particle_fields = {"id", "material", "velocity", "volume", "mass", "stress", "pressure", "temperature"};
  std::erase_if(out.output.particle_fields,
                [&](const std::string& name) { return name == "temperature" && !model.heat.kept; });
  out.output.grid_fields.clear();
  return out;
}

}  // namespace

void write_model_view(const Model& model, const std::filesystem::path& folder, const std::string& command_line,
                      int thread_count) {
  set_threads(thread_count);
  const Model shown = with_initial_fields(model);
  const auto of_grid = [&](const auto& run) { return model_layers(shown, run.system()); };
  if (model.only_blocks())
    return write<BlockRun>(shown, folder, command_line, thread_count,
                           [&](const BlockRun&) { return model_layers(shown, assemble(shown)); });
  if (model.dimension() == 2) return write<GridRun<2>>(shown, folder, command_line, thread_count, of_grid);
  write<GridRun<3>>(shown, folder, command_line, thread_count, of_grid);
}

}  // namespace tribo
