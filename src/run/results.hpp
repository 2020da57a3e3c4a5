// SPDX-License-Identifier: MIT
/// What a run writes: particle and grid files, histories, the energy ledger.
#pragma once

#include "output/history.hpp"
#include "output/vtk.hpp"
#include "run/block_results.hpp"
#include "run/tracers.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <filesystem>
#include <optional>

namespace tribo {

/// `run_000012.vtp`
std::string numbered(std::int64_t number, const std::string& extension);

/// Everything the histories need to know of the present state.
struct Ledgers {
  double potential = 0.0;      ///< of constant gravity, zero at the start   [energy]
  double external_work = 0.0;  ///< body forces as functions, loads          [energy]
  double boundary_work = 0.0;  ///< prescribed velocities, rigid particles   [energy]
  double damping = 0.0;        ///< taken out                                [energy]
  double contact = 0.0;        ///< dissipated by contact                    [energy]
  double interface = 0.0;      ///< stored in imperfect interfaces           [energy]
};

template <int Dim>
class Results {
 public:
  /// Starts the files, or continues them after `resume_time`.
  Results(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, std::filesystem::path folder,
          std::optional<double> resume_time);

  void write_particles(std::int64_t number);
  void write_history(double dt);
  /// What happened at joints since the last call.
  void write_events();
  /// Energies at the start, for the residual; kept for restart.
  double initial_energy = 0.0;
  std::optional<BlockResults> blocks;

 private:
  /// Of what history `k` asks for: all, a material or a particle.
  Measures measures_of(std::size_t k, const Measures& all, const std::vector<Measures>& bodies) const;
  double quantity(const HistoryQuantity& q, const Measures& m, const Ledgers& ledgers, double dt) const;
  Vec3 reaction(const HistoryQuantity& q) const;
  PairLedger contact_of(const HistoryQuantity& q) const;
  Ledgers ledgers(const Measures& all) const;
  void write_grid(std::int64_t number);
  void write_cracks(std::int64_t number);
  void write_joints(std::int64_t number);
  void write_tips();

  const Model& model_;
  System<Dim>& system_;
  Stepper<Dim>& stepper_;
  Tracers<Dim> tracers_;
  std::filesystem::path folder_;
  Collection particles_, grid_, cracks_, joints_;
  std::optional<History> history_, energy_, events_, tips_;
};

}  // namespace tribo
