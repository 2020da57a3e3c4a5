// SPDX-License-Identifier: MIT
/// The state of a run: velocity fields, bodies, cracks, joints and time.
#pragma once

#include "grid/nodes.hpp"
#include "grid/partition.hpp"
#include "materials/material.hpp"
#include "model/model.hpp"
#include "particles/bins.hpp"
#include "particles/particles.hpp"
#include "solver/state/crack.hpp"
#include "solver/state/joint_surface.hpp"
#include "solver/state/load_clock.hpp"
#include "solver/state/load_controller.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace tribo {

class Assembly;

/// For a bin of particles that cracks intersect: the velocity field to which each particle belongs at each node of its
/// stencil, with the nodes in order, x fastest. The side is found from the segment between particle and node. 0: the
/// segment crosses no crack; 1: it crosses the first crack of the node; 2: the second; 3: both.
struct CutBin {
  /// Per particle of the bin: index of its first entry in `sides`; -1 if all its sides are 0.
  std::vector<std::int32_t> first;
  std::vector<std::uint8_t> sides;  ///< 0 to 3, as above
  /// With several cracks: bit k is set if the segment crosses the k-th crack listed at the block.
  std::vector<std::uint64_t> crossed;

  /// Sides of a particle of the bin at the nodes of its stencil; null if all are 0.
  const std::uint8_t* of(std::uint32_t particle) const {
    const std::int32_t at = first[particle];
    return at < 0 ? nullptr : sides.data() + at;
  }
};

/// One velocity field: the nodes that all bodies assigned to it share. Where cracks intersect the bodies, the
/// particles on the other side of a crack use additional fields.
template <int Dim>
struct Field {
  explicit Field(const Lattice<Dim>& lattice) : map(lattice) {}
  BlockMap<Dim> map;
  NodeLayer nodes;
  /// "+" schemes: mass and momentum of the updated particles, which replace `nodes` at the end of the step; else empty.
  NodeLayer nodes_again;
  AlignedVector<FilterNode> filter;  ///< XPIC, FMPM: velocities during filtering; else empty
  NodeLayer increment;               ///< XPIC, FMPM: momentum scattered by the filter; else empty
  /// USAVG: velocities that strain the particles at the start of the step, after contact, prescribed velocities and
  /// filters; else empty.
  std::vector<Vec3> start_velocities;
  AlignedVector<HeatNode> heat;   ///< heat conduction: nodal temperatures; else empty
  AlignedVector<CellNode> cells;  ///< B-bar: volume means of cells; else empty
  bool rigid_contact = false;     ///< field of a rigid body in contact with others; its velocity is prescribed
  bool curved = false;            ///< some body of it is drawn with a curved surface and is rigid or elastic
  std::int64_t block = -1;        ///< number of the rigid block whose field it is; -1: of none
  /// Number of the field of the same bodies with side 0; the field itself if its side is 0.
  std::size_t base_field = 0;
  int side = 0;  ///< side of the cracks as in CutBin, 0 to 3
};

/// What files show of contact at a particle.
template <int Dim>
struct ContactOfParticle {
  std::uint32_t particle = 0;
  bool slips = false;
  Vec<Dim> traction = Vec<Dim>::Zero();  ///< on the particle's body [stress]
  Vec<Dim> normal = Vec<Dim>::Zero();    ///< outward
};

/// The particles of one material, or of one of its bodies if they touch each other.
template <int Dim>
struct Body {
  Body(std::size_t count, bool with_deformation, double kernel_shift, int colours_per_axis)
      : particles(count, with_deformation), bins(kernel_shift, colours_per_axis) {}

  std::string name;
  std::shared_ptr<const Material> law;
  int material = 0;       ///< index into Model::materials
  int own_material = 0;   ///< the same, or the entry of this body alone; see ContactSpec::kinds
  std::size_t field = 0;  ///< number of the velocity field; `no_field` for rigid bodies without contact
  static constexpr std::size_t no_field = static_cast<std::size_t>(-1);
  /// Number of the rigid block in System::blocks that the particles represent; -1: none.
  std::int64_t block = -1;
  /// Numbers of the fields for the sides 1, 2 and 3 of CutBin.
  std::array<std::size_t, 3> across_fields{no_field, no_field, no_field};
  /// Per bin: its index in `cut_bins`, or -1 if no crack is near; empty without cracks.
  std::vector<std::int32_t> cut;
  std::vector<CutBin> cut_bins;
  /// Contact at a particle; null if it is open.
  const ContactOfParticle<Dim>* contact_of(std::size_t particle) const {
    const auto found = std::lower_bound(contacts.begin(), contacts.end(), particle,
                                        [](const auto& contact, std::size_t p) { return contact.particle < p; });
    return found != contacts.end() && found->particle == particle ? &*found : nullptr;
  }
  /// Sides of the particles of a bin; null if all are 0.
  const CutBin* cut_bin(std::size_t bin) const {
    if (cut.empty() || cut[bin] < 0) return nullptr;
    const CutBin& here = cut_bins[static_cast<std::size_t>(cut[bin])];
    return here.sides.empty() ? nullptr : &here;
  }
  Particles<Dim> particles;
  Bins<Dim> bins;
  std::size_t history = 0;               ///< first history column
  std::vector<double*> history_columns;  ///< pointers to the history columns, updated after every sort
  MatrixColumn affine;    ///< APIC: sum over nodes of w v (x_i - x)^T                    [velocity length]
  VectorColumn filtered;  ///< XPIC, FMPM: the filtered velocity; after the move see Gather::record_change
  VectorColumn start;     ///< "+" schemes: position at the start of the step             [length]
  /// Initial half widths of the particle domains if they differ between particles [length].
  VectorColumn half_size;
  /// Half axes of the initial particle domains, row by row, if some are not along the grid axes [length].
  MatrixColumn half_axes;
  ScalarColumn generation;  ///< splitting: number of times that the particle has been halved
  /// Initial half widths of the particle domains if all are equal [length].
  Vec<Dim> uniform_half_size = Vec<Dim>::Zero();
  double thickness = 1.0;     ///< out of the plane                                           [length]
  MatrixColumn domain;        ///< CPDI: F at the start of the step
  VectorColumn damped;        ///< particle damping: velocity that no condition prescribes    [velocity]
  VectorColumn load;          ///< external force                                             [force]
  VectorColumn origin;        ///< position at the start of the run                           [length]
  ScalarColumn load_set;      ///< bit k set: particle condition k acts on the particle
  ScalarColumn contact_slip;  ///< laws with history: distance slid since the faces last stuck  [length]
  ScalarColumn contact_bond;  ///< laws with history: 1 intact, -1 broken, 0 no bond
  /// For output: the particles at a face in contact in ascending order, until the particles are sorted again.
  std::vector<ContactOfParticle<Dim>> contacts;
  ScalarColumn temperature;           ///< [temperature]
  VectorColumn temperature_gradient;  ///< conduction                                             [temperature/length]
  /// Conduction: particle temperature minus the interpolated nodal temperature [temperature].
  ScalarColumn temperature_residual;
  ScalarColumn heated;          ///< dissipated work per initial volume that has been converted to heat   [stress]
  ScalarColumn expanded;        ///< thermal expansion: temperature of the last update of the stress   [temperature]
  ScalarColumn expansion_work;  ///< work of the stress on thermal expansion, per initial volume       [stress]
  double expansion = 0.0;       ///< coefficient of linear thermal expansion [1/temperature]
  ScalarColumn crossings;       ///< for output: number of times the particle moved to another cell
  ScalarColumn cell_number;     ///< for output: number of the current cell, -1 before the first count
  ScalarColumn volumetric;      ///< B-bar: scratch for the rate of volume change or the mean stress
  double heat_capacity = 0.0;   ///< [energy/(mass temperature)]
  double conductivity = 0.0;    ///< [power/(length temperature)]
  /// Taylor-Quinney coefficient: fraction of the dissipated work that becomes heat.
  double taylor_quinney = 0.0;
  double reference_temperature = 0.0;   ///< temperature at which the material properties hold [temperature]
  Vec3 cell = Vec3::Ones();             ///< edge lengths of the grid cells [length]
  double residual_share = 0.0;          ///< fraction of the temperature residual that is removed in this step
  bool volume_of_displacement = false;  ///< contact computes gaps from displacements, not from positions
  double particle_damping = 0.0;
  double total_mass = 0.0;

  /// Columns to prefetch; updated after every sort.
  std::vector<const double*> read_by_scatter, read_by_gather;

  /// Calls f(number) for the particles and the ghosts, in the order that the particles have in a single process.
  template <class F>
  void each_known_particle(F&& f) const {
    if (particles.ghosts() == 0) {
      for (std::uint32_t i = 0; i < particles.size(); ++i) f(i);
      return;
    }
    for (const std::uint32_t k : bins.by_block()) {
      const Bin& bin = bins.with_ghosts()[k];
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) f(i);
    }
  }
  /// Sums the masses of the particles.
  void weigh() {
    total_mass = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) total_mass += particles.mass()[i];
  }
  /// Updates the pointers to the particle columns, which move when particles are sorted.
  void refresh() {
    history_columns.clear();
    for (std::size_t k = 0; k < law->history().size(); ++k) history_columns.push_back(particles.column(history + k));
    read_by_scatter.clear(), read_by_gather.clear();
    const auto read = [](std::vector<const double*>& by, const auto& columns) {
      for (const double* column : columns)
        if (column) by.push_back(column);
    };
    for (auto* by : {&read_by_scatter, &read_by_gather}) {
      read(*by, particles.x()), read(*by, particles.v()), read(*by, particles.stress());
      by->push_back(particles.volume());
      if (affine) read(*by, particles[affine]);
    }
    read_by_scatter.push_back(particles.mass());
    read(read_by_gather, particles.F());
    read(read_by_gather, history_columns);
  }
};

/// Particles of a body that the stage of the model places.
template <int Dim>
struct PlacedParticles {
  bool rigid = false;    ///< whether `body` is a number among the rigid bodies
  std::size_t body = 0;  ///< number of the body
  Particles<Dim> particles;
};

/// The row of particles that enters at a source, and how far the last row has moved since then.
template <int Dim>
struct Inflow {
  std::size_t source = 0;  ///< index into Model::sources
  PlacedParticles<Dim> row;
  double travel = 0.0;  ///< [length]
};

/// The numbers of the particles that a piece of the model has at the start.
struct PieceNumbers {
  int piece = 0;  ///< index into Model::pieces
  std::int64_t first = 0, last = 0;
};

/// All state of a run on a grid.
template <int Dim>
struct System {
  explicit System(const Lattice<Dim>& l) : lattice(l) {}
  Lattice<Dim> lattice;
  /// Which process updates the particles of a block; null if there is only one.
  std::shared_ptr<Partition<Dim>> partition;
  Analysis analysis = Analysis::plane_strain;
  std::vector<Field<Dim>> fields;
  std::vector<Body<Dim>> bodies;
  std::vector<Crack<Dim>> cracks;
  std::vector<JointSurface<Dim>> joints;
  /// Bodies of rigid particles; their velocities follow functions of the material or the motion of a block.
  std::vector<Body<Dim>> rigids;
  /// Rigid blocks in the grid, each represented by one body of `rigids`; null without blocks.
  std::shared_ptr<Assembly> blocks;
  bool contact_at_faces = false;  ///< the contact conditions hold at faces, between nodes
  std::string contact_reason;     ///< a phrase on why they hold there or at nodes; empty without contact
  double time = 0.0;
  std::int64_t step = 0;
  LoadClock load_clock;
  LoadController load_controller;
  double drift = 0.0;  ///< largest distance any particle may have moved since the last sort [cells]
  bool sorted = false;
  std::vector<PieceNumbers> pieces;          ///< in the order of the numbers
  std::vector<PlacedParticles<Dim>> placed;  ///< to be added when the stage of the model begins
  std::vector<Inflow<Dim>> inflow;           ///< one for each source of the model
  std::int64_t deleted_failed = 0;           ///< particles removed because they failed, or at a given time
  std::int64_t deleted_outside = 0;          ///< particles removed because they left the grid
  std::int64_t entered = 0;                  ///< particles that came from sources

  /// Whether the particles must be sorted into bins before the next step.
  bool sort_is_due() const { return !sorted || !(drift < 1.0 - 1e-6); }
};

/// Saves and restores the particles and their bins. Columns, fields and material follow from the model; all other
/// members are computed when particles are sorted, or are used within a step only. `binned`: the next step does not
/// sort the particles, so they must lie in their bins.
template <int Dim>
void archive(Archive& a, Body<Dim>& body, const Lattice<Dim>& lattice, bool binned) {
  auto& [name, law, material, own_material, field, block, across_fields, cut, cut_bins, particles, bins, history,
         history_columns, affine, filtered, damped, start, half_size, half_axes, generation, uniform_half_size,
         thickness, domain, load, origin, load_set, contact_slip, contact_bond, contacts, temperature,
         temperature_gradient, temperature_residual, heated, expanded, expansion_work, expansion, crossings,
         cell_number, volumetric, heat_capacity, conductivity, taylor_quinney, reference_temperature, cell,
         residual_share, volume_of_displacement, particle_damping, total_mass, read_by_scatter, read_by_gather] = body;
  a("particles", particles), a("total_mass", total_mass), archive(a, bins, lattice);
  if (!a.reading() || bins.list().empty()) return;  // none before the first step, which sorts
  if (bins.before(bins.list().size()) != particles.size() || (binned && !bins.hold(lattice, particles)))
    refuse_checkpoint("the particles of '" + name + "' are not sorted into bins");
  const auto negative = [count = particles.size()](const double* x) {
    return std::any_of(x, x + count, [](double y) { return y < 0; });
  };
  if (negative(particles.mass()) || negative(particles.volume()))
    refuse_checkpoint("a particle of '" + name + "' has a negative mass or volume");
}

/// Refuses a system, restored from a checkpoint, with points or particles far outside of the grid. Particles that lie
/// in their bins are inside; those that the next step sorts may have left the grid, but not by many sizes of it.
template <int Dim>
void check(const System<Dim>& system) {
  static constexpr double farthest = 100;  // sizes of the grid
  const Lattice<Dim>& lattice = system.lattice;
  const double most = farthest * (lattice.high - lattice.low).norm();
  const auto look = [&](const std::vector<Vec<Dim>>& points) {
    for (const Vec<Dim>& x : points)
      if (!((x - lattice.low).norm() < most))
        refuse_checkpoint("a point of a crack or joint lies far outside of the grid");
  };
  for (const auto& crack : system.cracks) {
    look(crack.x), look(crack.face[0]), look(crack.face[1]);
    for (const CrackTip& tip : crack.tips)
      if (tip.active && tip.body >= system.bodies.size()) refuse_checkpoint("a crack tip lies in no body");
  }
  for (const auto& surface : system.joints) {
    look(surface.x);
    for (const auto& sample : surface.samples)
      if (!(sample.local.norm() < most)) refuse_checkpoint("a part of a joint lies far outside of the grid");
  }
  for (const auto* list : {&system.bodies, &system.rigids})
    for (const Body<Dim>& body : *list)
      for (std::size_t i = 0; i < body.particles.size(); ++i)
        if (!((body.particles.position(i) - lattice.low).norm() < most))
          refuse_checkpoint("a particle of '" + body.name + "' lies far outside of the grid");
  if (system.step < 0 || system.time < 0) refuse_checkpoint("its time or its number of steps is negative");
}

/// Saves and restores bodies, cracks, joints and time. Fields are computed in every step. Blocks have an archive of
/// their own, since they also run without a grid.
template <int Dim>
void archive(Archive& a, System<Dim>& system) {
  auto& [lattice, partition, analysis, fields, bodies, cracks, joints, rigids, blocks, contact_at_faces, contact_reason,
         time, step, load_clock, load_controller, drift, sorted, pieces, placed, inflow, deleted_failed,
         deleted_outside, entered] = system;
  a.version(6);
  a("time", time), a("step", step), a("load_clock", load_clock), a("load_controller", load_controller);
  a("drift", drift), a("sorted", sorted);
  for (std::size_t k = 0; k < inflow.size(); ++k) a("travel" + std::to_string(k), inflow[k].travel);
  a("deleted_failed", deleted_failed), a("deleted_outside", deleted_outside), a("entered", entered);
  a.each("crack", cracks), a.each("joints", joints);
  for (auto* list : {&bodies, &rigids})
    for (std::size_t k = 0; k < list->size(); ++k) {
      a.enter((list == &bodies ? "body" : "rigid") + std::to_string(k));
      archive(a, (*list)[k], lattice, !system.sort_is_due());
      a.leave();
    }
  if (a.reading()) check(system);
}

}  // namespace tribo
