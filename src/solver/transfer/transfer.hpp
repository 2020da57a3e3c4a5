// SPDX-License-Identifier: MIT
/// The transfers between particles and nodes, for one kernel.
#pragma once

#include "solver/state/system.hpp"

#include <memory>

namespace tribo {

/// What a scatter adds to the nodes.
enum class Scatter {
  momentum,            ///< sum w m, sum w m v (+ affine part)
  force,               ///< sum w f_ext - V sigma grad w
  momentum_and_force,  ///< both in one sweep
  filtered,            ///< sum w m, sum w m v*, v* the filtered velocity columns
  heat,                ///< sum w m c in place of the mass, of m c T and of the flow V k grad T into the node, in x
  heat_detail,         ///< sum w m c in place of the mass, of m c times the share of the detail that is to go
  volumetric,          ///< sum w V in place of the mass, of V times the volumetric column, in x
  volume  ///< sum w V in place of the mass, sum w V x (or displacements), sum V grad w in place of the force
};

/// Whether the slopes of the weights count, too.
inline bool pulls(Scatter what) {
  return what == Scatter::force || what == Scatter::momentum_and_force || what == Scatter::heat ||
         what == Scatter::volume;
}

/// What a gather computes for the particles. S f is the sum of w_Ip f_I over the nodes.
enum class GatherTask {
  update,              ///< velocity, position, deformation and stress, as the members of Gather say
  filtered_velocity,   ///< filtered velocity = S v
  temperature,         ///< temperature += dt S dT/dt, its gradient, and detail = temperature - S T
  temperature_detail,  ///< temperature -= share of the detail - S of that
  volume_rate,         ///< volumetric column = div v
  cell_mean            ///< volumetric column = S of the cells' values
};

/// A gather: its task and the options of an update.
struct Gather {
  GatherTask task = GatherTask::update;
  bool move = false;        ///< velocity and position
  double dt = 0.0;          ///< of the motion                                            [time]
  double flip = 1.0;        ///< share of v + dt S a; the rest is S v
  double damping = 0.0;     ///< particle damping, subtracts damping dt S v               [1/time]
  double strain_dt = 0.0;   ///< > 0: deformation, stress and history over this time      [time]
  bool from_start = false;  ///< weights at the positions of the start of the step
  bool b_bar = false;       ///< the strain changes volume at the rate in the volumetric column, not at div v
  bool plane_stress = false, axisymmetric = false;
  bool exponential = false;  ///< F <- exp(L dt) F to second order, not the motion of the particles
};

/// What a gather found out, the same for any number of threads.
struct GatherResult {
  double travel = 0.0;  ///< largest particle displacement along an axis   [cells]
  bool valid = true;    ///< false: a velocity is not finite, or a volume not positive
};

/// The nodes of a body's fields: its own, and those across cracks.
template <int Dim>
struct Target {
  std::array<const BlockMap<Dim>*, 4> map{};
  std::array<NodeNumbers, 4> nodes{};

  Target(const BlockMap<Dim>& own_map, NodeNumbers own_nodes) : map{&own_map}, nodes{own_nodes} {}
  /// One layer of all fields of a body.
  template <class N>
  Target(const Body<Dim>& body, std::vector<Field<Dim>>& fields, AlignedVector<N> Field<Dim>::*layer)
      : Target(fields[body.field].map, fields[body.field].*layer) {
    for (std::size_t k = 0; k < body.across.size(); ++k)
      if (body.across[k] < fields.size())
        map[k + 1] = &fields[body.across[k]].map, nodes[k + 1] = fields[body.across[k]].*layer;
  }
};

template <int Dim>
class Transfers {
 public:
  virtual ~Transfers() = default;
  /// Adds the particles of a body to zeroed or partly filled nodes. `only`: flags of lattice blocks; particles of other
  /// blocks are left out.
  virtual void scatter(Body<Dim>& body, const Target<Dim>& target, Scatter what, bool from_start, bool axisymmetric,
                       const std::vector<char>* only = nullptr) const = 0;
  virtual GatherResult gather(Body<Dim>& body, const Target<Dim>& target, const Gather& what) const = 0;
  /// Nodes of a stencil along each axis.
  virtual int stencil_width() const = 0;
  /// The lowest node of the stencil of each particle of a bin.
  virtual void lowest_nodes(Body<Dim>& body, const Lattice<Dim>& lattice, const Bin& bin,
                            std::vector<Index<Dim>>& lowest) const = 0;
  virtual double shift() const = 0;
  virtual int colours_per_axis() const = 0;
};

/// The transfers of a scheme's kernel.
template <int Dim>
std::unique_ptr<Transfers<Dim>> make_transfers(const Scheme& scheme);

/// Sums over the particles of each cell, kept at its lowest node, for the same bins of particles.
template <int Dim>
std::unique_ptr<Transfers<Dim>> make_cell_transfers(const Scheme& scheme);

}  // namespace tribo
