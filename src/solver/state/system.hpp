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
#include <optional>
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
  std::vector<NodeLayer> rigid;  ///< per rigid body: the velocity its particles prescribe
  NodeLayer filter;              ///< XPIC, FMPM: increment and sum of the filter; empty without
  NodeLayer increment;           ///< XPIC, FMPM: what is scattered during filtering; empty without
  NodeLayer volumes;             ///< contact: volume, its first moment and its gradient; empty without
  NodeLayer heat;                ///< conduction, see heat.hpp; empty without
  NodeLayer cells;               ///< B-bar: volume and mean of the volumetric part in a cell; empty without
  bool rigid_contact = false;    ///< the field of a rigid body that others touch: its velocity is prescribed
  std::int64_t block = -1;       ///< the rigid block whose field it is
  std::size_t home = 0;          ///< the field of the same bodies on the nodes' own side of cracks
  int side = 0;                  ///< as in CutBin
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
  std::optional<std::size_t> affine;     ///< APIC: first column of sum w v (x_i - x)^T, Dim x Dim row by row
  std::optional<std::size_t> filtered;   ///< XPIC, FMPM: columns of the filtered velocity
  std::optional<std::size_t> start;      ///< "+" schemes: columns of the position at the start of the step
  std::optional<std::size_t> half_size;  ///< GIMP, CPDI with mixed particle sizes: columns of the domain's half widths
  Vec<Dim> uniform_half_size = Vec<Dim>::Zero();
  std::optional<std::size_t> domain;          ///< CPDI: F at the start of the step, Dim x Dim columns row by row
  std::optional<std::size_t> load;            ///< external force on particles, Dim columns
  std::optional<std::size_t> origin;          ///< position at the start of the run, Dim columns, for displacements
  std::optional<std::size_t> first_inverse;   ///< F^-1 at the start where that was no identity, Dim x Dim columns
  std::optional<std::size_t> load_set;        ///< bit k set: particle condition k acts on the particle
  std::optional<std::size_t> contact_memory;  ///< laws that remember: columns slip, bond
  std::optional<std::size_t> contact_view;    ///< for output: columns state, traction, normal
  std::optional<std::size_t> temperature;     ///< with conduction followed by its gradient, and its detail
  std::optional<std::size_t> heated;          ///< dissipated work per initial volume that is heat already
  std::optional<std::size_t> crossings;       ///< for output: how often it changed its cell, and the cell it is in
  std::optional<std::size_t> volumetric;      ///< B-bar: rate of volume change or stress while it is averaged
  double heat_capacity = 0.0;                 ///< [energy/(mass temperature)]
  double conductivity = 0.0;                  ///< [power/(length temperature)]
  double taylor_quinney = 0.0;                ///< share of the dissipated work that becomes heat
  double reference_temperature = 0.0;         ///< of the given properties [temperature]
  Vec3 cell = Vec3::Ones();                   ///< edges of the grid's cells [length]
  double detail_share = 0.0;                  ///< of the detail of the temperature that goes in this step
  bool volume_of_displacement = false;        ///< contact looks at displacements, not positions
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
      for (std::size_t k = 0; affine && k < Dim * Dim; ++k) by->push_back(particles.column(*affine + k));
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
         filtered, start, half_size, uniform_half_size, domain, load, origin, first_inverse, load_set, contact_memory,
         contact_view, temperature, heated, crossings, volumetric, heat_capacity, conductivity, taylor_quinney,
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
