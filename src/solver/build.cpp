// SPDX-License-Identifier: MIT
#include "solver/build.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "blocks/assembly.hpp"
#include "solver/cracks/crack_build.hpp"
#include "solver/impulse_choice.hpp"
#include "solver/joints/joint_build.hpp"
#include "solver/later_particles.hpp"
#include "solver/rigid/block_points.hpp"
#include "solver/transfer/transfer.hpp"

#include "contact/contact_law.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace tribo {
namespace {

template <int Dim>
void keep_temperature(const Model& model, Body<Dim>& body) {
  const MaterialSpec& spec = model.materials[static_cast<std::size_t>(body.material)];
  auto& particles = body.particles;
  body.heat_capacity = spec.heat_capacity, body.conductivity = spec.conductivity;
  body.reference_temperature = model.heat.reference;
  body.temperature = particles.add("temperature", Dimension::temperature);
  if (model.heat.conduction) {
    body.temperature_gradient = particles.add_vector("temperature_gradient", Dimension::none);
    body.temperature_residual = particles.add("temperature_detail", Dimension::temperature);
  }
  if (model.heat.work_heating && body.law->dissipation_index() >= 0) {
    body.heated = particles.add("heated", Dimension::stress);
    body.taylor_quinney = spec.taylor_quinney;
  }
  if (model.heat.expansion && spec.expansion != 0.0) {
    body.expansion = spec.expansion;
    body.expanded = particles.add("stress_temperature", Dimension::temperature, model.heat.reference);
    body.expansion_work = particles.add("expansion_work", Dimension::stress);
  }
}

template <int Dim>
void add_optional_columns(Body<Dim>& body, const Model& model) {
  auto& particles = body.particles;
  const Scheme& scheme = model.scheme;
  if (scheme.transfer == Transfer::apic) body.affine = particles.add_matrix("affine", Dimension::none);
  if (scheme.kernel == Kernel::cpdi) body.domain = particles.add_matrix("domain", Dimension::none);
  if (scheme.transfer == Transfer::xpic || scheme.transfer == Transfer::fmpm)
    body.filtered = particles.add_vector("filtered_velocity", Dimension::velocity);
  if (scheme.extrapolate_again && scheme.order != UpdateOrder::usf)
    body.start = particles.add_vector("start_position", Dimension::length);
  if (model.stage.damps_prescribed || (model.damps_particles() && !model.node_conditions.empty()))
    body.damped = particles.add_vector("damped_velocity", Dimension::velocity);
  if (!model.particle_conditions.empty() || model.body_force.acts_on_particles() || model.stage.loads)
    body.load = particles.add_vector("load", Dimension::force);
  body.origin = particles.add_vector("origin", Dimension::length);
  if (model.heat.kept && !body.law->rigid()) keep_temperature(model, body);
  if (model.output.has_field("cell_crossings") && !body.law->rigid()) {
    body.crossings = particles.add("cell_crossings", Dimension::none);
    body.cell_number = particles.add("cell", Dimension::none, -1.0);
  }
  if (scheme.b_bar && !body.law->rigid()) body.volumetric = particles.add("volumetric", Dimension::none);
  const ContactSpec& contact = model.contact;
  if (!contact.active) return;
  body.volume_of_displacement = contact.separation == Separation::displacements;
  const auto any_law = [&](auto&& is) {
    return (contact.default_law && is(*contact.default_law)) ||
           std::any_of(contact.pair_laws.begin(), contact.pair_laws.end(),
                       [&](const auto& p) { return is(*p.second); });
  };
  if (contact.keeps_memory || any_law([](const ContactLaw& law) { return law.has_memory(); })) {
    body.contact_slip = particles.add("contact_slip", Dimension::length);
    body.contact_bond = particles.add("contact_bond", Dimension::none);
  }
}

// Stores the particles from `begin` to before `end`, and returns their mass.
template <int Dim>
double fill(Body<Dim>& body, const Seeds& seeds, std::size_t begin, std::size_t end, std::optional<std::size_t> angle) {
  auto& particles = body.particles;
  const auto x = particles.x(), v = particles.v(), origin = particles[body.origin];
  const auto F = particles.F();
  const auto stress = particles.stress();
  double mass = 0.0;
  Seeds::Iterator next(seeds, begin);
  for (std::size_t i = begin; i < end; ++i, ++next) {
    const Seed& seed = *next;
    const auto at = static_cast<int>(i);
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      x[d][i] = origin[d][i] = seed.x[axis];
      v[d][i] = seed.v[axis];
      if (body.half_size) particles[body.half_size][d][i] = seed.half_size[axis];
    }
    if (body.half_axes) {
      const Mat3 axes = seed.half_axes.value_or(Mat3(seed.half_size.asDiagonal()));
      for (std::size_t k = 0; k < Dim * Dim; ++k)
        particles[body.half_axes][k][i] = axes(static_cast<int>(k) / Dim, static_cast<int>(k) % Dim);
    }
    mass += particles.mass()[i] = seed.mass;
    particles.volume()[i] = seed.volume * seed.F.determinant();
    if (body.temperature) particles[body.temperature][i] = seed.temperature;
    if (angle) particles.column(*angle)[i] = seed.angle;
    if (F[0]) store_full<Dim>(seed.F, F, at);
    store_symmetric<Dim>(seed.stress, stress, at);
  }
  return mass;
}

template <int Dim>
void fill(Body<Dim>& body, const Seeds& seeds, std::int64_t first_id) {
  constexpr std::size_t piece = std::size_t{1} << 14;
  std::optional<std::size_t> angle;
  for (std::size_t k = 0; k < body.law->history().size(); ++k)
    if (body.law->history()[k].name == material_angle) angle = body.history + k;
  std::vector<double> masses((seeds.size() + piece - 1) / piece);
  parallel_for(static_cast<std::ptrdiff_t>(masses.size()), [&](std::ptrdiff_t k) {
    const std::size_t begin = static_cast<std::size_t>(k) * piece;
    masses[static_cast<std::size_t>(k)] = fill(body, seeds, begin, std::min(begin + piece, seeds.size()), angle);
  });
  body.total_mass += std::accumulate(masses.begin(), masses.end(), 0.0);
  std::iota(body.particles.id.begin(), body.particles.id.end(), first_id);
}

// History variables that tables of particles give.
template <int Dim>
void fill_histories(Body<Dim>& body, const Model& model, const Seeds& seeds) {
  const auto& variables = body.law->history();
  std::size_t i = 0;
  for (const Seed& seed : seeds) {
    const std::size_t particle = i++;
    if (seed.table < 0) continue;
    for (const auto& history : model.tables[static_cast<std::size_t>(seed.table)].histories)
      for (std::size_t k = 0; k < variables.size(); ++k)
        if (variables[k].name == history.name)
          body.particles.column(body.history + k)[particle] = history.values[seed.row];
  }
}

template <int Dim>
Body<Dim> make_body(const Model& model, int material, const Seeds& seeds, std::int64_t first_id,
                    const Transfers<Dim>& transfers) {
  const MaterialSpec& spec = model.materials[static_cast<std::size_t>(material)];
  const bool keep_deformation = spec.law->needs_deformation() || model.scheme.kernel == Kernel::cpdi ||
                                model.contact.active || model.output.wants_deformation() || model.fracture ||
                                model.splitting;
  Body<Dim> body(seeds.size(), keep_deformation, transfers.shift(), transfers.colours_per_axis());
  body.name = spec.name;
  body.law = spec.law;
  body.material = model.contact.kind(material), body.own_material = material;
  body.particle_damping = spec.particle_damping.value_or(0.0);

  const Seed first = seeds.front();
  body.thickness = 2 * first.half_size[2];
  body.uniform_half_size = first.half_size.template head<Dim>();
  const bool mixed = seeds.any_kind([&](const Seed& s) {
    return (s.half_size.template head<Dim>() - body.uniform_half_size).norm() > 1e-12 * body.uniform_half_size.norm();
  });
  const bool splits = model.splitting && !spec.law->rigid();
  if (mixed || (splits && model.scheme.kernel == Kernel::gimp))
    body.half_size = body.particles.add_vector("half_size", Dimension::length);
  if (splits) body.generation = body.particles.add("generation", Dimension::none);
  if (splits || seeds.any_kind([](const Seed& s) { return s.half_axes.has_value(); }))
    body.half_axes = body.particles.add_matrix("half_axes", Dimension::length);
  if (spec.law->history().size() > most_history_variables)
    throw std::logic_error("the law of '" + spec.name + "' has more than " + std::to_string(most_history_variables) +
                           " history variables");
  body.history = body.particles.columns().size();
  for (const auto& variable : spec.law->history())
    body.particles.add(variable.name, variable.dimension, variable.initial);
  add_optional_columns(body, model);
  fill(body, seeds, first_id);
  if (!model.tables.empty()) fill_histories(body, model, seeds);
  body.refresh();
  return body;
}

// Every block is a rigid body with a velocity field of its own.
template <int Dim>
void add_blocks(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, std::int64_t next_id) {
  const BlocksSpec& spec = *model.blocks;
  system.blocks = std::make_shared<Assembly>(model.blocks, Dim, model.analysis == Analysis::plane_stress,
                                             model.body_force.gravity, model.time.max_step);
  system.blocks->grid_forces.resize(system.blocks->bodies.size());
  for (std::size_t k = 0; k < system.blocks->block_count(); ++k) {
    const auto& group = spec.groups[static_cast<std::size_t>(system.blocks->bodies[k].group)];
    const Seeds seeds = block_points(system.blocks->shapes[k], system.blocks->motion[k].x, group.material,
                                     group.density, Dim == 2, spec.thickness, system.lattice.spacing.minCoeff());
    auto body = make_body<Dim>(model, group.material, seeds, next_id, transfers);
    next_id += static_cast<std::int64_t>(seeds.size());
    body.block = static_cast<std::int64_t>(k);
    body.name = group.name.empty() ? "block " + std::to_string(k + 1) : group.name;
    system.rigids.push_back(std::move(body));
  }
}

// Adds the additional fields for the other sides of cracks to each field of deformable bodies.
template <int Dim>
void add_sides(System<Dim>& system) {
  for (std::size_t f = 0; f < system.fields.size(); ++f) system.fields[f].base_field = f;
  if (system.cracks.empty()) return;
  const std::size_t bases = system.fields.size(), sides = system.cracks.size() == 1 ? 1 : 3;
  for (std::size_t base = 0; base < bases; ++base) {
    if (system.fields[base].rigid_contact) continue;
    for (std::size_t side = 1; side <= sides; ++side) {
      for (auto& body : system.bodies)
        if (body.field == base) body.across_fields[side - 1] = system.fields.size();
      system.fields.emplace_back(system.lattice);
      system.fields.back().base_field = base, system.fields.back().side = static_cast<int>(side);
    }
  }
}

// Assigns velocity fields to bodies: one field for all without contact, else one per material or per group of
// materials that share a field, or per body of a material whose bodies touch each other.
template <int Dim>
void assign_fields(const Model& model, System<Dim>& system) {
  if (!model.contact.active) {
    system.fields.emplace_back(system.lattice);
    for (auto& body : system.rigids) body.field = Body<Dim>::no_field;
    return;
  }
  std::map<int, std::size_t> field_of;
  for (auto* list : {&system.bodies, &system.rigids})
    for (auto& body : *list) {
      const MaterialSpec& spec = model.materials[static_cast<std::size_t>(body.material)];
      if (body.block >= 0) {
        body.field = system.fields.size();
        system.fields.emplace_back(system.lattice).rigid_contact = true;
        system.fields.back().block = body.block;
        continue;
      }
      if (spec.law->rigid() && !spec.touches()) {
        body.field = Body<Dim>::no_field;
        continue;
      }
      const int owner = spec.share_field_with >= 0 ? spec.share_field_with : body.own_material;
      const auto [entry, fresh] = field_of.try_emplace(owner, system.fields.size());
      if (fresh) system.fields.emplace_back(system.lattice);
      body.field = entry->second;
      system.fields[body.field].rigid_contact = spec.law->rigid();
    }
}

// Adds the numbers of the particles of a material that are present, piece by piece, from `next` on.
void number_pieces(const Seeds& seeds, std::size_t present, std::int64_t next, std::vector<PieceNumbers>& pieces) {
  std::size_t k = 0;
  for (const Seed& seed : seeds) {
    if (k++ == present) break;
    if (seed.piece >= 0 && (pieces.empty() || pieces.back().piece != seed.piece))
      pieces.push_back({seed.piece, next, next});
    else if (seed.piece >= 0)
      pieces.back().last = next;
    ++next;
  }
}

// Marks the fields of bodies whose surfaces are curved, and remain so: they are rigid or elastic.
template <int Dim>
void mark_curved_fields(const Model& model, System<Dim>& system) {
  std::vector<bool> curved(model.materials.size(), false);
  for (const Piece& piece : model.pieces)
    if (piece.material >= 0 && piece.region && piece.region->curved())
      curved[static_cast<std::size_t>(piece.material)] = true;
  const auto is_ball = [&](const Body<Dim>& body) {
    const int group = system.blocks->bodies[static_cast<std::size_t>(body.block)].group;
    return model.blocks->groups[static_cast<std::size_t>(group)].shape == BlockGroup::Shape::ball;
  };
  for (const auto* list : {&system.bodies, &system.rigids})
    for (const Body<Dim>& body : *list) {
      if (body.field == Body<Dim>::no_field) continue;
      const bool keeps_shape = body.law->rigid() || (body.law->dissipation_index() < 0 && !body.law->liquid());
      if ((body.block >= 0 && is_ball(body)) || (keeps_shape && curved[static_cast<std::size_t>(body.own_material)]))
        system.fields[body.field].curved = true;
    }
  for (auto& field : system.fields) field.curved = system.fields[field.base_field].curved;
}

}  // namespace

template <int Dim>
System<Dim> build_system(const Model& model, Seeds seeds) {
  Vec<Dim> low, high;
  Index<Dim> cells;
  for (std::size_t d = 0; d < Dim; ++d) {
    low[static_cast<Eigen::Index>(d)] = model.grid.low[d];
    high[static_cast<Eigen::Index>(d)] = model.grid.high[d];
    cells[d] = model.grid.cells[d];
  }
  System<Dim> system{Lattice<Dim>(low, high, cells)};
  system.analysis = model.analysis;
  auto [at_faces, reason] = choose_impulses(model, seeds, system.lattice);
  system.contact_at_faces = at_faces, system.contact_reason = std::move(reason);
  const auto transfers = make_transfers<Dim>(model.scheme);
  std::int64_t next_id = 0;
  const std::vector<LaterSeed> later = later_seeds(model);
  std::vector<Seeds> of_material(model.materials.size());
  for (const Seed& seed : seeds) of_material[static_cast<std::size_t>(seed.material)].push_back(seed);
  seeds = {};  // its memory, before that of the bodies
  return_freed_memory();
  for (int m = 0; m < static_cast<int>(model.materials.size()); ++m) {
    Seeds mine = std::move(of_material[static_cast<std::size_t>(m)]);
    const std::size_t present = mine.size();
    std::vector<int> stages;  // of the particles that are not present yet
    for (const LaterSeed& l : later)
      if (l.seed.material == m) mine.push_back(l.seed), stages.push_back(l.stage);
    if (mine.empty()) continue;
    const MaterialSpec& of = model.materials[static_cast<std::size_t>(m)];
    const int piece = mine.front().piece;
    auto body = with_memory_for("the particles of '" + of.name + "'",
                                present == 0 ? of.origin
                                : piece < 0  ? model.grid.origin
                                             : model.pieces[static_cast<std::size_t>(piece)].origin,
                                [&] { return make_body<Dim>(model, m, mine, next_id, *transfers); });
    number_pieces(mine, present, next_id, system.pieces);
    next_id += static_cast<std::int64_t>(mine.size());
    body.cell.setConstant(system.lattice.spacing[0]);
    body.cell.template head<Dim>() = system.lattice.spacing;
    for (int d = 0; d < Dim; ++d)
      if (model.scheme.kernel == Kernel::gimp &&
          body.uniform_half_size[d] > 0.5 * system.lattice.spacing[d] * (1 + 1e-12))
        throw InputError(of.origin, "particles of '" + body.name +
                                        "' are larger than a cell; uGIMP needs at least one per cell and axis");
    mine = {};
    if (!stages.empty()) set_aside(model, body, present, stages, system);
    (body.law->rigid() ? system.rigids : system.bodies).push_back(std::move(body));
  }
  return_freed_memory();
  if (model.blocks)
    with_memory_for("the blocks", model.blocks->origin, [&] { add_blocks(model, system, *transfers, next_id); });
  assign_fields(model, system);
  if (!model.cracks.empty())
    with_memory_for("the cracks", model.cracks.front().origin,
                    [&] { add_cracks(model, system, transfers->stencil_width()); });
  add_interfaces(model, system);
  add_sides(system);
  mark_curved_fields(model, system);
  if (system.bodies.empty())
    throw InputError(Origin{}, "the model has no deformable particle; give a <Body> with a material");
  const auto& periodic = model.grid.periodic;
  if ((periodic[0] || periodic[1] || periodic[2]) && (model.contact.active || !system.rigids.empty()))
    throw InputError(
        model.grid.origin,
        "a periodic grid takes neither contact nor rigid particles yet; hold bodies by conditions on nodes");
  return system;
}

template System<2> build_system<2>(const Model&, Seeds);
template System<3> build_system<3>(const Model&, Seeds);

}  // namespace tribo
