// SPDX-License-Identifier: MIT
/// What a step works on.
#pragma once

#include "grid/nodes.hpp"
#include "materials/material.hpp"
#include "model/model.hpp"
#include "particles/bins.hpp"
#include "particles/particles.hpp"
#include "solver/state/crack.hpp"
#include "solver/state/joint_surface.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tribo {

class Assembly;

/// Which of its fields a particle of a cut bin gives to and takes from, node by node of its stencil, x fastest: 0 what
/// lies on the node's own side of all cracks, 1 across its first crack, 2 across its second, 3 across both.
struct CutBin {
  std::vector<std::int32_t> first;  ///< per particle of the bin: where its sides begin, or -1: all are 0
  std::vector<std::uint8_t> sides;
  std::vector<std::uint64_t> crossed;  ///< with several cracks: bits of those between particle and node

  const std::uint8_t* of(std::uint32_t particle) const {
    const std::int32_t at = first[particle];
    return at < 0 ? nullptr : sides.data() + at;
  }
};

/// One velocity field: the nodes that all bodies assigned to it share. What lies across cracks has fields of its own.
template <int Dim>
struct Field {
  explicit Field(const Lattice<Dim>& lattice) : map(lattice) {}
  BlockMap<Dim> map;
  NodeLayer nodes;
  std::vector<AlignedVector<PrescribedNode>> rigid;  ///< per rigid body without a field of its own
  AlignedVector<FilterNode> filter;                  ///< XPIC, FMPM; empty without
  NodeLayer increment;                               ///< XPIC, FMPM: momentum scattered by the filter; empty without
  AlignedVector<VolumeNode> volumes;                 ///< contact; empty without
  AlignedVector<HeatNode> heat;                      ///< conduction; empty without
  AlignedVector<CellNode> cells;                     ///< B-bar; empty without
  bool rigid_contact = false;  ///< the field of a rigid body that others touch: its velocity is prescribed
  std::int64_t block = -1;     ///< the rigid block whose field it is
  std::size_t home = 0;        ///< the field of the same bodies on the nodes' own side of cracks
  int side = 0;                ///< as in CutBin
};

/// The particles of one material.
template <int Dim>
struct Body {
  Body(std::size_t count, bool with_deformation, double kernel_shift, int colours_per_axis)
      : particles(count, with_deformation), bins(kernel_shift, colours_per_axis) {}

  std::string name;
  std::shared_ptr<const Material> law;
  int material = 0;       ///< index into Model::materials
  std::size_t field = 0;  ///< of rigid bodies: only if others touch them, else `no_field`
  static constexpr std::size_t no_field = static_cast<std::size_t>(-1);
  std::int64_t block = -1;                                          ///< which of System::blocks it shows to the grid
  std::array<std::size_t, 3> across{no_field, no_field, no_field};  ///< fields of the sides 1, 2, 3
  std::vector<std::int32_t> cut;                                    ///< per bin: which of `cut_bins`, or -1; or empty
  std::vector<CutBin> cut_bins;
  const CutBin* cut_bin(std::size_t bin) const {
    return cut.empty() || cut[bin] < 0 ? nullptr : &cut_bins[static_cast<std::size_t>(cut[bin])];
  }
  Particles<Dim> particles;
  Bins<Dim> bins;
  std::size_t history = 0;               ///< first history column
  std::vector<double*> history_columns;  ///< refreshed after every sort
  MatrixColumn affine;     ///< APIC: sum over nodes of w v (x_i - x)^T                    [velocity length]
  VectorColumn filtered;   ///< XPIC, FMPM: the filtered velocity                          [velocity]
  VectorColumn start;      ///< "+" schemes: position at the start of the step             [length]
  VectorColumn half_size;  ///< half widths of the domains where these differ              [length]
  Vec<Dim> uniform_half_size = Vec<Dim>::Zero();  ///< half widths of the domains where all are alike  [length]
  MatrixColumn domain;                            ///< CPDI: F at the start of the step
  VectorColumn load;                    ///< external force                                             [force]
  VectorColumn origin;                  ///< position at the start of the run                           [length]
  MatrixColumn first_inverse;           ///< F^-1 at the start of the run where F was not the identity
  ScalarColumn load_set;                ///< bit k set: particle condition k acts on the particle
  ScalarColumn contact_slip;            ///< laws with memory: distance slid since the faces last stuck  [length]
  ScalarColumn contact_bond;            ///< laws with memory: 1 whole, -1 broken, 0 no bond
  ScalarColumn contact_state;           ///< for output: 0 open, 1 stick, 2 slip
  VectorColumn contact_traction;        ///< for output                                                 [stress]
  VectorColumn contact_normal;          ///< for output
  ScalarColumn temperature;             ///< [temperature]
  VectorColumn temperature_gradient;    ///< conduction                                             [temperature/length]
  ScalarColumn temperature_detail;      ///< conduction: what of the temperature the nodes do not see  [temperature]
  ScalarColumn heated;                  ///< dissipated work per initial volume that is heat already   [stress]
  ScalarColumn crossings;               ///< for output: how often the particle changed its cell
  ScalarColumn cell_number;             ///< for output: number of the cell it is in, -1 before the first look
  ScalarColumn volumetric;              ///< B-bar: rate of volume change or mean stress while it is averaged
  double heat_capacity = 0.0;           ///< [energy/(mass temperature)]
  double conductivity = 0.0;            ///< [power/(length temperature)]
  double taylor_quinney = 0.0;          ///< share of the dissipated work that becomes heat
  double reference_temperature = 0.0;   ///< of the given properties [temperature]
  Vec3 cell = Vec3::Ones();             ///< edges of the grid's cells [length]
  double detail_share = 0.0;            ///< of the detail of the temperature that goes in this step
  bool volume_of_displacement = false;  ///< contact looks at displacements, not positions
  double particle_damping = 0.0;
  double total_mass = 0.0;

  std::vector<const double*> read_by_scatter, read_by_gather;  ///< columns to bring closer; refreshed after every sort

  /// Points to the columns where they are now.
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

template <int Dim>
struct System {
  explicit System(const Lattice<Dim>& l) : lattice(l) {}
  Lattice<Dim> lattice;
  Analysis analysis = Analysis::plane_strain;
  std::vector<Field<Dim>> fields;
  std::vector<Body<Dim>> bodies;
  std::vector<Crack<Dim>> cracks;
  std::vector<JointSurface<Dim>> joints;
  std::vector<Body<Dim>> rigids;  ///< particles that prescribe velocities: `velocity` follows the material's functions
  std::shared_ptr<Assembly> blocks;  ///< rigid blocks in the grid, each with one of `rigids`; or null
  double time = 0.0;
  std::int64_t step = 0;
  double drift = 0.0;  ///< largest distance any particle may have moved since the last sort [cells]
  bool sorted = false;
};

/// The particles and their bins. Columns, fields and material belong to the model; the rest follows from the particles
/// when they are sorted, or serves within a step.
template <int Dim>
void archive(Archive& a, Body<Dim>& body, const Lattice<Dim>& lattice) {
  auto& [name, law, material, field, block, across, cut, cut_bins, particles, bins, history, history_columns, affine,
         filtered, start, half_size, uniform_half_size, domain, load, origin, first_inverse, load_set, contact_slip,
         contact_bond, contact_state, contact_traction, contact_normal, temperature, temperature_gradient,
         temperature_detail, heated, crossings, cell_number, volumetric, heat_capacity, conductivity, taylor_quinney,
         reference_temperature, cell, detail_share, volume_of_displacement, particle_damping, total_mass,
         read_by_scatter, read_by_gather] = body;
  a("particles", particles), archive(a, bins, lattice);
}

/// Bodies, cracks, joints and the time. Fields are those of a step; blocks archive themselves, as they also run without
/// a grid.
template <int Dim>
void archive(Archive& a, System<Dim>& system) {
  auto& [lattice, analysis, fields, bodies, cracks, joints, rigids, blocks, time, step, drift, sorted] = system;
  a.version(1);
  a("time", time), a("step", step), a("drift", drift), a("sorted", sorted);
  a.each("crack", cracks), a.each("joints", joints);
  for (auto* list : {&bodies, &rigids})
    for (std::size_t k = 0; k < list->size(); ++k) {
      a.enter((list == &bodies ? "body" : "rigid") + std::to_string(k));
      archive(a, (*list)[k], lattice);
      a.leave();
    }
}

}  // namespace tribo
