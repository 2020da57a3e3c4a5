// SPDX-License-Identifier: MIT
#include "solver/stage.hpp"

#include "blocks/assembly.hpp"
#include "model/blocks.hpp"
#include "solver/neighbours/body_occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

using Kind = StageAction::Kind;

// Whether a law is that of a material, or derived from it.
bool stems_from(const Model& model, const JointLaw* law, int material) {
  const JointLaw* named = model.materials[static_cast<std::size_t>(material)].joint.get();
  if (law == named || !model.blocks) return law == named;
  for (std::size_t rule = 0; rule <= model.blocks->joints.size(); ++rule) {
    const BlockLaws& laws = model.blocks->laws_of(rule);
    if (laws.initial.get() != named) continue;
    if (law == laws.later.get()) return true;
    for (const auto& [groups, both] : laws.by_groups)
      if (law == both[0].get() || law == both[1].get()) return true;
  }
  return false;
}

// Bonds a joint or breaks its bond, as the actions that it fits say.
void bond_or_unbond(const Model& model, const std::vector<StageAction>& actions, const BlockPairing& place,
                    const JointLaw& law, Joint& joint, StageReport& report) {
  for (const StageAction& action : actions) {
    if (!action.joints || !action.joints->fits(place, model.dimension() == 2)) continue;
    if (action.law >= 0 && !stems_from(model, &law, action.law)) continue;
    if (action.kind == Kind::bond && law.bond(joint)) ++report.bonded;
    if (action.kind == Kind::unbond && law.unbond(joint)) ++report.unbonded;
  }
}

// The factor by which a joint of a grid becomes stiffer.
double adopt(const JointLaw& law, const JointLaw& former, Joint& joint, const JointSite& site) {
  const double normal = joint.kn * joint.area, shear = joint.ks * joint.area;
  law.adopt(joint, former, site);
  const auto factor = [&](double now, double before) { return before > 0 ? now * joint.area / before : 1.0; };
  return std::max({1.0, factor(joint.kn, normal), factor(joint.ks, shear)});
}

template <int Dim>
void change_joints(const Model& model, const Model& former, const std::vector<StageAction>& actions,
                   System<Dim>& system, Stepper<Dim>& stepper, StageReport& report) {
  double stiffer = 1.0;
  for (JointSurface<Dim>& surface : system.joints) {
    if (surface.interface) continue;
    const JointLaw* before = nullptr;
    if (surface.crack != JointSurface<Dim>::none) {
      before = former.cracks[surface.crack].joint.get();
    } else {
      const auto [a, b] = surface.material;
      before = former.contact.joints.at({std::min(a, b), std::max(a, b)}).law.get();
    }
    JointSite site;
    site.plane = Dim == 2, site.thickness = model.grid.thickness;
    for (std::size_t k = 0; k < surface.joints.size(); ++k) {
      site.number = k;
      if (before) stiffer = std::max(stiffer, adopt(*surface.law, *before, surface.joints[k], site));
      BlockPairing at;
      at.place.template head<Dim>() = surface.x[k];
      at.normal = surface.axes[k].n;
      bond_or_unbond(model, actions, at, *surface.law, surface.joints[k], report);
    }
  }
  stepper.joints().stiffened(stiffer);
}

template <int Dim>
void excavate(const StageAction& action, System<Dim>& system, StageReport& report) {
  std::int64_t removed = 0;
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (Body<Dim>& body : *bodies) {
      if (body.block >= 0 || (action.material >= 0 && action.material != body.material)) continue;
      std::vector<std::uint32_t> stays;
      for (std::uint32_t i = 0; i < body.particles.size(); ++i) {
        Vec3 x = Vec3::Zero();
        x.template head<Dim>() = body.particles.position(i);
        if (!action.where->contains(x)) stays.push_back(i);
      }
      if (stays.size() == body.particles.size()) continue;
      removed += static_cast<std::int64_t>(body.particles.size() - stays.size());
      body.particles.reorder(stays);
      body.weigh();
    }
  if (removed == 0) report.warnings.push_back(action.origin.text() + ": there is nothing to excavate in this shape");
  report.excavated += removed;
}

template <int Dim>
void set_stress(const Model& model, const StageAction& action, System<Dim>& system, StageReport& report) {
  std::int64_t count = 0;
  for (Body<Dim>& body : system.bodies) {
    if (body.law->rigid() || (action.material >= 0 && action.material != body.material)) continue;
    std::vector<std::uint32_t> inside;
    for (std::uint32_t i = 0; i < body.particles.size(); ++i) {
      Vec3 x = Vec3::Zero();
      x.template head<Dim>() = body.particles.position(i);
      if (action.where->contains(x)) inside.push_back(i);
    }
    if (inside.empty()) continue;
    if (!keeps_stress(*body.law)) {
      report.warnings.push_back(action.origin.text() + ": '" + body.name +
                                "' keeps no given stress; its particles are left as they are");
      continue;
    }
    count += static_cast<std::int64_t>(inside.size());
    const auto columns = body.particles.stress();
    for (const std::uint32_t i : inside) {
      Vec3 x = Vec3::Zero();
      x.template head<Dim>() = body.particles.position(i);
      const Mat3 before = load_symmetric<Dim>(columns, static_cast<int>(i));
      Mat3 now = action.adds ? Mat3(Mat3::Zero()) : before;
      action.stress.set(x, now);
      if (action.adds) now += before;
      if (!now.allFinite())
        throw InputError(action.origin, "a function of this stress has no finite value at a particle of '" +
                                            model.materials[static_cast<std::size_t>(body.material)].name + "'");
      store_symmetric<Dim>(now, columns, static_cast<int>(i));
    }
  }
  if (count == 0) report.warnings.push_back(action.origin.text() + ": there is no particle in this shape");
  report.stressed += count;
}

// Adds the particles of the stage whose centres do not lie in other particles.
template <int Dim>
void place(const Model& model, System<Dim>& system, StageReport& report) {
  if (system.placed.empty()) return;
  Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& placed : system.placed)
    for (std::size_t i = 0; i < placed.particles.size(); ++i)
      low = low.cwiseMin(placed.particles.position(i)), high = high.cwiseMax(placed.particles.position(i));
  const Vec<Dim> margin = Vec<Dim>::Constant(2 * system.lattice.spacing.maxCoeff());
  BodyOccupancy<Dim> matter(model, system.lattice, low - margin, high + margin);
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (Body<Dim>& body : *bodies)
      if (body.field != Body<Dim>::no_field) matter.add(body);
  for (const auto& placed : system.placed) {
    Body<Dim>& body = (placed.rigid ? system.rigids : system.bodies)[placed.body];
    std::vector<std::uint32_t> fitting;
    for (std::uint32_t i = 0; i < placed.particles.size(); ++i)
      if (body.field == Body<Dim>::no_field || !matter.contains(placed.particles.position(i))) fitting.push_back(i);
    body.particles.append(placed.particles, fitting);
    body.weigh();
    report.placed += static_cast<std::int64_t>(fitting.size());
    report.covered += static_cast<std::int64_t>(placed.particles.size() - fitting.size());
  }
  system.placed.clear();
  if (report.covered > 0)
    report.warnings.push_back(std::to_string(report.covered) +
                              " particles are not placed, because there is matter at their places: excavate it first");
}

}  // namespace

const JointLaw* former_law(const Model& model, const Model& former, const JointLaw* law) {
  for (std::size_t k = 0; k < std::min(model.materials.size(), former.materials.size()); ++k)
    if (model.materials[k].joint && model.materials[k].joint.get() == law) return former.materials[k].joint.get();
  // laws that are derived from those of the input: of later contacts, and with inherited properties of surfaces
  if (!model.blocks || !former.blocks) return nullptr;
  for (std::size_t rule = 0; rule <= std::min(model.blocks->joints.size(), former.blocks->joints.size()); ++rule) {
    const BlockLaws &now = model.blocks->laws_of(rule), &then = former.blocks->laws_of(rule);
    if (law == now.initial.get()) return then.initial.get();
    if (law == now.later.get()) return then.later.get();
    for (const auto& [groups, laws] : now.by_groups)
      for (std::size_t which = 0; which < 2; ++which)
        if (law == laws[which].get()) return which == 0 ? then.initial_of(groups) : then.later_of(groups);
  }
  return nullptr;
}

template <int Dim>
StageReport begin_stage(const Model& model, const Model& former, const std::vector<StageAction>& actions,
                        System<Dim>& system, Stepper<Dim>& stepper) {
  StageReport report;
  change_joints(model, former, actions, system, stepper, report);
  if (system.blocks) begin_stage(model, former, actions, *system.blocks, report);
  for (const StageAction& action : actions)
    if (action.kind == Kind::excavate) excavate(action, system, report);
  for (const StageAction& action : actions)
    if (action.kind == Kind::stress) set_stress(model, action, system, report);
  place(model, system, report);
  system.sorted = false;
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (Body<Dim>& body : *bodies) body.refresh();
  for (const Origin& origin : stepper.loads().choose())
    report.warnings.push_back(origin.text() + ": this load selects no particle");
  if (model.stage.conditions || report.placed > 0 || report.stressed > 0) stepper.expect_jump();
  return report;
}

void begin_stage(const Model& model, const Model& former, const std::vector<StageAction>& actions, Assembly& blocks,
                 StageReport& report) {
  for (const ContactGroup& group : blocks.groups) {
    const std::span<Joint> joints(blocks.joints.data() + group.begin, group.end - group.begin);
    const std::size_t platen = blocks.platen_with(group.law);
    std::shared_ptr<const JointLaw> of_platen;
    if (platen < former.blocks->platens.size()) of_platen = Assembly::law_of_platen(*former.blocks, platen);
    const JointLaw* before = of_platen ? of_platen.get() : former_law(model, former, group.law);
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (before) group.law->adopt(joints[k], *before, blocks.site_of(group.begin + k));
      bond_or_unbond(model, actions, blocks.pairing_of(group.begin + k, group.kind), *group.law, joints[k], report);
    }
  }
  blocks.renew_forces();
}

template StageReport begin_stage(const Model&, const Model&, const std::vector<StageAction>&, System<2>&, Stepper<2>&);
template StageReport begin_stage(const Model&, const Model&, const std::vector<StageAction>&, System<3>&, Stepper<3>&);

}  // namespace tribo
