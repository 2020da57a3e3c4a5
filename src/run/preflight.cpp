// SPDX-License-Identifier: MIT
#include "run/preflight.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "run/bare_edges.hpp"
#include "run/block_run.hpp"
#include "run/body_gaps.hpp"
#include "run/body_report.hpp"
#include "run/contact_probe.hpp"
#include "run/crack_report.hpp"
#include "run/distant_bodies.hpp"
#include "run/effort.hpp"
#include "run/held_bodies.hpp"
#include "run/law_remarks.hpp"
#include "run/load_report.hpp"
#include "run/pore_pressure.hpp"
#include "run/setup_report.hpp"
#include "run/stage_report.hpp"
#include "run/step_size.hpp"
#include "run/sudden_gravity.hpp"
#include "run/tracers.hpp"
#include "run/travel_report.hpp"
#include "run/unit_remarks.hpp"
#include "solver/build.hpp"
#include "solver/impulse_choice.hpp"
#include "solver/measures.hpp"
#include "solver/state/limited_interface.hpp"
#include "solver/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace tribo {
namespace {

template <int Dim>
class Report {
 public:
  Report(const Model& model, int wanted_threads)
      : model_(model),
        seeds_(place_points(model)),
        system_(build_system<Dim>(model, seeds_)),
        stepper_(model, system_),
        h_(system_.lattice.smallest_spacing()) {
    return_arrays_above(4 << 20, 4 << 20);  // a report is made once: nothing is kept for later
    set_threads(sensible_threads(wanted_threads, particle_count(system_), system_.fields.size()));
    const Tracers<Dim> found(model_, system_);  // throws for a history of a point without particles
  }

  std::string text() {
    step_ = StepSize<Dim>(model_, system_).first();
    line(line_of_units(model_));
    for (auto& remark : remarks_on_units(model_, seeds_)) advice_.push_back(std::move(remark));
    take(describe_setup(model_, system_));
    if (system_.contact_reason.ends_with(faces_may_be_better))
      advice_.push_back("contact impulses act " + system_.contact_reason);
    for (auto& remark : remarks_on_contact_laws(model_)) advice_.push_back(std::move(remark));
    take(describe_bodies(model_, system_, seeds_));
    rigid_blocks();
    gaps();
    stiffness();
    interfaces();
    take(describe_holds(model_, system_, seeds_));
    pressures();
    if (const SuddenGravity gravity = sudden_gravity(model_);
        gravity.crack_slips || (gravity.slips && has_neighbours(model_, system_)))
      advice_.push_back(sudden_gravity_advice());
    for (auto& edge : bare_edges(model_)) advice_.push_back(std::move(edge));
    take(describe_loads(model_, system_));
    cracks();
    travel();
    steps();
    exchange();
    stages();
    seeds_ = {}, return_freed_memory();  // before the steps and files of the trial
    take(describe_effort(model_, system_, stepper_, step_.size));
    for (const auto& warning : model_.warnings) line(warning);
    if (!advice_.empty()) line("\nto look at:");
    for (const auto& a : advice_) line("- " + a);
    return out_;
  }

 private:
  void line(const std::string& text) { out_ += text + "\n"; }
  void take(const Remarks& remarks) {
    for (const auto& text : remarks.lines) line(text);
    advice_.insert(advice_.end(), remarks.advice.begin(), remarks.advice.end());
  }
  const MaterialSpec& material(int k) const { return model_.materials[static_cast<std::size_t>(k)]; }
  std::string name(int k) const { return "'" + material(k).name + "'"; }

  void rigid_blocks() {
    if (!system_.blocks) return;
    const Assembly& blocks = *system_.blocks;
    const double parts = std::max(1.0, std::ceil(step_.size / blocks.critical_step() * (1 - 1e-12)));
    line(format("rigid blocks: %zu, contacts between them %zu, bonds %zu; %.0f of their steps in one of the grid",
                blocks.block_count(), blocks.contacts.size(), blocks.bonds(), parts));
    for (const auto& body : system_.rigids) {
      if (body.block < 0) continue;
      const BlockBody& block = blocks.bodies[static_cast<std::size_t>(body.block)];
      const double cells =
          Dim == 2 ? std::sqrt(block.volume / model_.blocks->thickness) / h_ : std::cbrt(block.volume) / h_;
      if (cells < 3)
        advice_.push_back("'" + body.name + "' is " + counted(cells, "cell") +
                          " across: contact sees blocks of three cells and more well");
    }
  }

  // Shapes that share the sites of the grid do not overlap: the parallelograms that stand for cut particles may reach
  // a little beyond a curved face or a tip.
  bool may_overlap(int k) const {
    const auto of = [&](const auto& list, auto&& differs) {
      return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.material == k && differs(one); });
    };
    return model_.whole_particles || of(model_.points, [](const PointSpec&) { return true; }) ||
           of(model_.tables, [](const ParticleTable&) { return true; }) ||
           of(model_.pieces, [](const Piece& p) { return p.deformation.has_value(); }) ||
           of(system_.rigids, [](const Body<Dim>& b) { return b.block >= 0; });
  }

  void gaps() {
    static constexpr double touching = 1e-3;  // cells
    const bool separate = model_.contact.active;
    const auto grips = [&](int k) {
      const auto& sets = material(k).sets_velocity;
      return std::find(sets.begin(), sets.end(), true) != sets.end();
    };
    std::vector<std::string> touching_pairs, near_pairs;
    const Gaps gaps = smallest_gaps<Dim>(seeds_, system_.lattice);
    for (const auto& [pair, gap] : gaps) {
      if (grips(pair.first) || grips(pair.second)) {
        if (separate && gap < touching) sticks(pair, grips(pair.first));
        continue;
      }
      const std::string who = name(pair.first) + " and " + name(pair.second);
      if (gap < -touching && (may_overlap(pair.first) || may_overlap(pair.second))) {
        line("overlap: " + who + " by " + counted(-gap, "cell", "%.3g"));
        if (separate) advice_.push_back(who + " overlap at the start: contact will push them apart");
      } else if (gap < touching) {
        touching_pairs.push_back(who);
      } else if (gap < 1) {
        near_pairs.push_back(who + ", " + counted(gap, "cell", "%.3g"));
      }
      if (!separate && gap < 1)
        advice_.push_back(who +
                          (gap < touching
                               ? std::string(" share one velocity field: they stick where they touch") +
                                     (model_.cracks.empty() ? "" : ", but for cracks")
                               : std::string(" act on each other across the gap, as they share one velocity field")) +
                          "; <MultiMaterialMode> gives each its own");
      if (separate && gap > touching && gap < 1 && model_.contact.separation != Separation::edges)
        advice_.push_back(who + " are " + counted(gap, "cell", "%.3g") +
                          " apart: this way to find the gap may see contact before they touch; the default separation, "
                          "of the edges of particles, measures it");
    }
    list_pairs("touch: ", touching_pairs);
    if (separate)
      for (auto& text : distant_bodies(model_, seeds_, gaps, h_)) near_pairs.push_back(std::move(text));
    list_pairs("gap: ", near_pairs);
  }

  void sticks(const std::pair<int, int>& pair, bool first_grips) {
    const int rigid = first_grips ? pair.first : pair.second, other = first_grips ? pair.second : pair.first;
    if (!material(other).law->rigid())
      line("stick: " + name(other) + " sticks to " + name(rigid) +
           ", which is Rigid and sets the velocity of the nodes; RigidContact has contact");
  }

  // A line for each pair, or one for all if there are many.
  void list_pairs(const std::string& what, const std::vector<std::string>& pairs) {
    constexpr std::size_t listed = 6;
    if (pairs.size() > listed)
      line(what + std::to_string(pairs.size()) + " pairs of materials, the first of them " + pairs.front());
    else
      for (const std::string& pair : pairs) line(what + pair);
  }

  void stiffness() {
    int stiffest = -1, softest = -1;
    double most = 0.0, least = 1e300;
    for (const auto& body : system_.bodies) {
      const double modulus = body.law->wave_modulus();
      if (modulus > most) most = modulus, stiffest = body.material;
      if (modulus > 0 && modulus < least) least = modulus, softest = body.material;
    }
    if (stiffest == softest || softest < 0) return;
    line(format("stiffness contrast: %s is %.3g times as stiff as %s", name(stiffest).c_str(), most / least,
                name(softest).c_str()));
    if (most > 1e3 * least)
      advice_.push_back(name(stiffest) + " is so much stiffer than " + name(softest) +
                        " that it could be rigid (RigidContact), with larger time steps");
  }

  // Which directions of the imperfect interfaces are elastic in cells of this size.
  void interfaces() {
    if (!model_.contact.active) return;
    const auto tell = [&](const InterfaceLaw& law, int a, int b) {
      const auto limited = limited_interface(model_, system_.lattice, law, std::array{a, b});
      const std::string who = "interface of " + name(a) + " and " + name(b);
      const auto word = [](bool bonds) { return bonds ? "bonded" : "elastic"; };
      line(who + ": normal direction " + word(limited->bonds_normal()) + ", tangential direction " +
           word(limited->bonds_tangential()));
      if (limited->bonds_normal() != law.bonds_normal() || limited->bonds_tangential() != law.bonds_tangential())
        advice_.push_back("the " + who +
                          " is stiffer than 30 times the wave modulus over the cell size in a direction, which is "
                          "therefore bonded; smaller cells resolve it");
    };
    std::set<std::pair<int, int>> known;
    for (std::size_t i = 0; i < system_.bodies.size(); ++i)
      for (std::size_t j = i + 1; j < system_.bodies.size(); ++j) {
        const int a = system_.bodies[i].material, b = system_.bodies[j].material;
        const ContactLaw* law = model_.contact.law(a, b);
        if (law && law->interface() && known.insert({a, b}).second) tell(*law->interface(), a, b);
      }
  }

  // Particles that come and go.
  void exchange() {
    for (const SourceSpec& source : model_.sources)
      line(format("inlet of %s: %s of %.4g in a row, speed at the start %.4g", name(source.material).c_str(),
                  counted(source.count[0] * source.count[1], "particle").c_str(), source.size, source.speed(0.0)));
    if (model_.delete_leaving)
      line(format("particles that leave the grid are removed, at most %ld", model_.leave_limit.value_or(0)));
    for (const DeletionSpec& spec : model_.deletions)
      line("particles of " + name(spec.material) + " are removed " +
           (spec.time >= 0     ? format("at time %.6g", spec.time)
            : spec.opening > 0 ? format("once they have failed and their crack has opened by %.4g", spec.opening)
                               : std::string("once they have failed")));
  }

  void pressures() {
    for (const std::string& torn :
         {torn_by_pressure(system_), system_.blocks ? torn_by_pressure(*system_.blocks) : std::string()})
      if (!torn.empty()) advice_.push_back(torn);
  }

  void cracks() {
    take(describe_cracks(model_, system_));
    take(describe_interfaces(system_));
    if (system_.joints.empty()) return;
    // The points of interfaces and the masses of their nodes are known after a first step only.
    stepper_.advance(0.1 * step_.size);
    for (auto& remark : remarks_on_inclined_joints(model_, system_)) advice_.push_back(std::move(remark));
    const double stable = stepper_.joints().stable_step();
    const bool joints = std::any_of(system_.joints.begin(), system_.joints.end(),
                                    [](const auto& surface) { return !surface.interface; });
    if (stable < 1e300) line(format("%s: stable up to steps of %.6g", joints ? "joints" : "interfaces", stable));
    if (stable < 0.2 * step_.size)
      advice_.push_back(
          format("the joints shorten the step by a factor of %.2g; stiffnesses of a few times modulus over "
                 "cell size are stiff enough",
                 step_.size / stable));
    if (stable < step_.size) step_.size = stable, step_.set_by = "the stiffness of the joints";
  }

  void travel() {
    take(describe_travel(model_, seeds_));
    double fastest = 0.0;
    for (const Seed& s : seeds_) fastest = std::max(fastest, s.v.cwiseAbs().maxCoeff());
    if (fastest > 0.5 * step_.wave_speed && !model_.time.adaptive)
      advice_.push_back(
          format("particles start at %.2g of the wave speed: let the step follow them (custom task "
                 "AdjustTimeStep)",
                 fastest / step_.wave_speed));
  }

  void steps() {
    const auto unit = [&](Dimension dimension) { return model_.units.name(dimension); };
    line(format("time step: %.6g %s, set by %s (wave speed %.6g %s)", step_.size, unit(Dimension::time).c_str(),
                step_.set_by.c_str(), step_.wave_speed, unit(Dimension::velocity).c_str()));
    damping();
    line(format("steps: about %.0f to time %.6g", std::ceil(model_.time.end / step_.size), model_.time.end));
  }

  // Damping is explicit in time: each step takes its rate times the step of the velocity.
  void damping() {
    const auto check = [&](const std::optional<Expression>& rate, const char* name) {
      if (!rate || !rate->is_constant()) return;
      if (const double part = (*rate)(Variables{}) * step_.size; part > 0.5)
        advice_.push_back(
            format("%s takes %.3g times the velocity in each step: rates far below 1 over the step, "
                   "which is %.3g, are stable and accurate",
                   name, part, 1 / step_.size));
    };
    check(model_.damping.grid, "<Damping>");
    check(model_.damping.particle, "<PDamping>");
  }

  // The models of the stages are built, too, which throws for conditions that select nothing.
  void stages() {
    for (const std::string& text : describe_stages(model_, seeds_)) line(text);
    for (const StageSpec& stage : model_.stages) {
      auto system = build_system<Dim>(*stage.model, seeds_);
      const Stepper<Dim> stepper(*stage.model, system);
    }
  }

  const Model& model_;
  Seeds seeds_;
  System<Dim> system_;
  Stepper<Dim> stepper_;
  double h_;
  typename StepSize<Dim>::First step_;
  std::string out_;
  std::vector<std::string> advice_;
};

}  // namespace

std::string preflight(const Model& model, int threads) {
  if (model.only_blocks())
    return with_memory_for("this model", model.blocks->origin, [&] { return describe_blocks(model, threads); });
  return with_memory_for("this model", model.grid.origin, [&] {
    return model.dimension() == 2 ? Report<2>(model, threads).text() : Report<3>(model, threads).text();
  });
}

}  // namespace tribo
