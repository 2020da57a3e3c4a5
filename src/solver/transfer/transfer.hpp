// SPDX-License-Identifier: MIT
/// Transfers between particles and nodes.
#pragma once

#include "solver/state/system.hpp"

#include <memory>

namespace tribo {

/// The sums over particles that a scatter adds to the nodes; w is the shape function.
enum class Scatter {
  momentum,            ///< sum w m, sum w m v (+ affine part)
  force,               ///< sum w f_ext - V sigma grad w
  momentum_and_force,  ///< both in one loop
  filtered,            ///< sum w m, sum w m v*, v* the filtered velocity columns
  heat,  ///< sum w m c in place of the mass, of m c T in place of momentum x, of the heat flow V k grad T in place of y
  /// Sum w m c in place of the mass; sum of m c times the fraction of the residual to be removed.
  heat_residual,
  volumetric,  ///< sum w V in place of the mass; in the x component, sum of V times the volumetric column
  volume       ///< sum w V in place of the mass, sum w V x (or displacements), sum V grad w in place of the force
};

/// The values that a gather computes for the particles. S f is the sum of w_Ip f_I over the nodes.
enum class GatherTask {
  update,                ///< velocity, position, deformation and stress, according to the members of Gather
  filtered_velocity,     ///< filtered velocity = S v
  damped_velocity,       ///< damped velocity = S v
  temperature,           ///< temperature += dt S dT/dt, its gradient, and residual = temperature - S T
  temperature_residual,  ///< temperature -= r - S S+ r with the fraction r of the residual
  volume_rate,           ///< volumetric column = div v
  cell_mean              ///< volumetric column = S of the cells' values
};

/// A gather: its task and the options of an update.
struct Gather {
  GatherTask task = GatherTask::update;
  bool move = false;  ///< update velocity and position
  double dt = 0.0;    ///< of the motion                                            [time]
  double flip = 1.0;  ///< FLIP fraction: weight of v + dt S a; the remainder is S v
  /// Particle damping, subtracts damping dt S v, or with `damps_part` damping dt times the damped velocity [1/time].
  double damping = 0.0;
  bool damps_part = false;
  double strain_dt = 0.0;      ///< > 0: deformation, stress and history over this time      [time]
  bool from_start = false;     ///< use the shape functions at the positions at the start of the step
  bool b_bar = false;          ///< use the rate of volume change in the volumetric column in place of div v
  bool record_change = false;  ///< store S a times the change of the velocity in the columns of filtered velocities
  bool plane_stress = false, axisymmetric = false;
  bool exponential = false;  ///< F <- exp(L dt) F to second order in place of (1 + L dt) F
};

/// Results of a gather, independent of the number of threads.
struct GatherResult {
  double travel = 0.0;  ///< largest particle displacement along an axis   [cells]
  bool valid = true;    ///< false: a velocity or temperature is not finite, or a volume is not positive
};

/// The nodes of the velocity fields of a body: its own field, and the additional fields for the sides 1, 2 and 3 of
/// cracks.
template <int Dim>
struct Target {
  std::array<const BlockMap<Dim>*, 4> map{};
  std::array<NodeNumbers, 4> nodes{};

  Target(const BlockMap<Dim>& own_map, NodeNumbers own_nodes) : map{&own_map}, nodes{own_nodes} {}
  /// One nodal layer of all fields of a body.
  template <class N>
  Target(const Body<Dim>& body, std::vector<Field<Dim>>& fields, AlignedVector<N> Field<Dim>::*layer)
      : Target(fields[body.field].map, fields[body.field].*layer) {
    for (std::size_t k = 0; k < body.across_fields.size(); ++k)
      if (body.across_fields[k] < fields.size())
        map[k + 1] = &fields[body.across_fields[k]].map, nodes[k + 1] = fields[body.across_fields[k]].*layer;
  }
};

/// The transfers of one kernel.
template <int Dim>
class Transfers {
 public:
  virtual ~Transfers() = default;
  /// Adds the sums `what` over the particles of a body to the nodes. `from_start`: use the shape functions at the
  /// positions at the start of the step. `only`: flags of blocks; particles in blocks without the flag are omitted.
  virtual void scatter(Body<Dim>& body, const Target<Dim>& target, Scatter what, bool from_start, bool axisymmetric,
                       const BlockFlags<Dim>* only = nullptr) const = 0;
  /// Interpolates nodal values to the particles of a body and updates the particles according to `what`.
  virtual GatherResult gather(Body<Dim>& body, const Target<Dim>& target, const Gather& what) const = 0;
  /// The same from the nodes `from`, and a scatter of the updated particles to the nodes `to` with the shape functions
  /// of the gather. It gives the same bits as a gather and a scatter one after the other, but takes less time. The two
  /// must not depend on each other: the numbers of nodes that the scatter changes are none of those that the gather
  /// reads.
  virtual GatherResult gather_and_scatter(Body<Dim>& body, const Target<Dim>& from, const Gather& what,
                                          const Target<Dim>& to, Scatter sums, bool axisymmetric) const;
  /// Number of nodes of a stencil along each axis.
  virtual int stencil_width() const = 0;
  /// Stores the lowest node of the stencil of each particle of a bin in `lowest`.
  virtual void lowest_nodes(Body<Dim>& body, const Lattice<Dim>& lattice, const Bin& bin,
                            std::vector<Index<Dim>>& lowest) const = 0;
  /// Offset of the particle position in the choice of the lowest node [cells].
  virtual double shift() const = 0;
  /// Number of colours of blocks along each axis such that blocks of one colour have no stencil node in common.
  virtual int colours_per_axis() const = 0;
};

/// Creates the transfers for the kernel of a scheme.
template <int Dim>
std::unique_ptr<Transfers<Dim>> make_transfers(const Scheme& scheme);

/// Creates transfers that sum over the particles of each cell, stored at its lowest node, for the same bins of
/// particles. Throws std::logic_error if the shape functions are not linear within a cell.
template <int Dim>
std::unique_ptr<Transfers<Dim>> make_cell_transfers(const Scheme& scheme);

}  // namespace tribo
