// SPDX-License-Identifier: MIT
/// How the equations of motion are solved: scheme, time steps, grid and damping.
#pragma once

#include "base/expression.hpp"
#include "base/statement.hpp"
#include "model/shape_functions.hpp"

#include <array>
#include <optional>

namespace tribo {

enum class Analysis { plane_strain, plane_stress, axisymmetric, solid };
enum class UpdateOrder { usf, usl, usavg };
enum class Transfer { flip, pic, blend, xpic, fmpm, apic };

struct Scheme {
  UpdateOrder order = UpdateOrder::usavg;
  bool extrapolate_again = true;  ///< MUSL ("+" variants of USL and USAVG): strains from re-extrapolated velocities
  Kernel kernel = Kernel::linear;
  Transfer transfer = Transfer::flip;
  double flip_fraction = 1.0;            ///< blend only: fraction of FLIP in the velocity update
  int filter_order = 2;                  ///< XPIC(m), FMPM(k)
  int filter_every = 1;                  ///< XPIC/FMPM in every n-th step, FLIP in the others (PeriodicXPIC)
  double filter_period = 0.0;            ///< simulated time between steps with XPIC/FMPM; 0: use filter_every
  bool exponential_deformation = false;  ///< true: F <- exp(L dt) F (second order); false: F <- (1 + L dt) F
  bool b_bar = false;                    ///< B-bar: volumetric strain and pressure are averaged around each particle
  double cpdi_limit = 1.0;  ///< largest distance of a CPDI corner from the centre in cells; larger domains are scaled
  /// Strains, or the velocity gradients that APIC keeps, are taken from the nodal velocities of the momentum update.
  /// With linear shape functions this is unstable: a node that particles hardly reach has an acceleration without
  /// bound.
  bool strains_follow_update() const {
    return transfer == Transfer::apic || (order != UpdateOrder::usf && !extrapolate_again);
  }
};

struct TimeControl {
  double end = 1.0;
  double until = 0.0;  ///< the next stage begins at this time, at the latest; 0: there is none until the end
  double max_step = 1.0;
  double courant = 0.5;
  double transport_courant = 0.5;  ///< fraction of the largest stable time step of conduction
  bool adaptive = false;           ///< the time step follows wave speed and particle speed during the run
  double velocity_courant = 0.5;   ///< adaptive: largest particle travel per step, in cells
  double max_increase = 1.1;       ///< adaptive: largest growth factor of the time step per adjustment
  /// Time on which a step must land: the begin of the next stage, or the end of the run.
  double next_end() const { return until > 0 ? until : end; }
};

/// The regular grid of the input, without the padding layers that the solver adds.
struct GridSpec {
  std::array<double, 3> low{}, high{};
  std::array<int, 3> cells{1, 1, 1};
  double thickness = 1.0;  ///< plane strain and plane stress
  /// Plane boundaries [axis][0: low end, 1: high end]; they must lie on grid lines.
  std::array<std::array<std::optional<double>, 2>, 3> symmetry;  ///< no normal velocity, even tangential velocity
  std::array<std::array<std::optional<double>, 2>, 3> wall;      ///< walls with boundary-modified shape functions
  std::array<bool, 3> periodic{};                                ///< [axis] the low and high end are identified
  Origin origin;
};

struct Damping {
  std::optional<Expression> grid, particle;        ///< [1/time]
  double function_time = 1.0;                      ///< consistent time of one unit of the functions' argument t
  std::optional<double> grid_gain, particle_gain;  ///< feedback damping: alpha' = gain (KE - target)
  std::optional<Expression> target_energy;
  double max_alpha = 0.0;  ///< 0: unlimited
};

/// Splitting of stretched particles and merging of crushed ones.
struct SplittingSpec {
  double longest = 1.0;  ///< length of a particle's domain above which it splits [cells]
  int generations = 6;   ///< how often a particle and its halves may split
  bool merge = true;     ///< neighbours that are small again merge
};

}  // namespace tribo
