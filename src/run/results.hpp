// SPDX-License-Identifier: MIT
/// The files of results of a run with a grid: particle and grid files, histories, energies.
#pragma once

#include "output/history.hpp"
#include "output/output_queue.hpp"
#include "output/vtk.hpp"
#include "run/block_results.hpp"
#include "run/grid_file.hpp"
#include "run/particle_fields.hpp"
#include "run/tracers.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <filesystem>
#include <optional>

namespace tribo {

template <int Dim>
class Results {
 public:
  /// Starts the files, or continues them after `resume_time`. `tracers`: the particles of histories of points. Files
  /// are written by jobs of the queue, from copies of the state.
  Results(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, std::filesystem::path folder,
          std::optional<double> resume_time, Tracers<Dim> tracers, OutputQueue& queue);

  /// What it writes.
  static ResultNames names(const Model& model, const System<Dim>& system);
  /// Files of particles, and of the grid, cracks, joints and blocks if the model has them.
  void write_files(std::int64_t number);
  void write_history(double dt);
  /// The last row of the histories: the time and the values.
  const std::vector<double>& last_row() const { return row_; }
  /// Fields of all particles that are written, at present.
  std::shared_ptr<const ParticleFields<Dim>> fields(const std::vector<std::string>& names, Precision precision);
  /// The events at joints and blocks since the last call.
  void write_events();
  /// Content of energy at the start, for the residual [energy]. Found by the constructor for a new run; to be set for
  /// one that is continued.
  double initial_energy = 0.0;
  std::optional<BlockResults> blocks;
  std::optional<GridNodes> grid_nodes;  ///< in a run of several processes, for the next file of the grid
  std::int64_t breaks = 0;              ///< bonds of joints that broke according to the events written by this object

 private:
  /// Sums over what history `k` refers to: all particles, a material or one particle.
  Measures measures_of(std::size_t k, const Measures& all, const std::vector<Measures>& bodies) const;
  /// Elastic strain of what history `k` refers to, and its mean of a history variable.
  void add_elastic_strain(std::size_t k, const std::vector<Measures>& bodies, Measures& m) const;
  double mean_variable(std::size_t k) const;
  std::vector<Body<Dim>*> written_bodies();
  void write_particles(std::int64_t number);
  void write_grid(std::int64_t number);
  void write_cracks(std::int64_t number);
  void write_joints(std::int64_t number);
  void write_tips();
  /// Whether there are files that belong together with those of the particles.
  static bool has_several_kinds(const System<Dim>& system);

  const Model& model_;
  System<Dim>& system_;
  Stepper<Dim>& stepper_;
  Tracers<Dim> tracers_;
  std::vector<std::optional<ElasticModuli>> moduli_;  ///< per body, if a history asks for elastic strains
  std::filesystem::path folder_;
  OutputQueue& queue_;
  Collection particles_, grid_, cracks_, joints_, all_;
  std::optional<History> history_, energy_, events_, tips_;
  std::vector<double> row_;
};

}  // namespace tribo
