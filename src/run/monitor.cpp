// SPDX-License-Identifier: MIT
#include "run/monitor.hpp"

#include "base/text.hpp"
#include "run/energy_advice.hpp"
#include "run/energy_balance.hpp"
#include "run/expanded_matter.hpp"
#include "run/sudden_gravity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tribo {
namespace {

constexpr double short_step = 0.1;  ///< over the first one
/// Share of stretched particles of a body that is noticed; where matter is cut or torn, a few are always drawn out.
constexpr double many = 0.01;

/// The error of the energy balance that rounding explains [energy]: of sums over many steps a small share of the
/// largest energy; the last digit of stored energies that are functions of the deformation gradient, whose terms are as
/// large as the moduli and cancel; and the last digit of positions, of which displacements are differences.
template <int Dim>
double rounding_error(const Model& model, const System<Dim>& system, const Measures& all, const RunEnergies& run) {
  constexpr double of_sums = 1e-9, digit = std::numeric_limits<double>::epsilon();
  double largest = 0.0;
  for (const double energy : {all.kinetic, all.stored, all.dissipated, all.expansion, run.potential, run.external_work,
                              run.boundary_work, run.stages, run.damping, run.transfer, run.contact, run.interface})
    largest = std::max(largest, std::abs(energy));
  double terms = all.mass * model.body_force.gravity.norm() *
                 std::max(system.lattice.low.cwiseAbs().maxCoeff(), system.lattice.high.cwiseAbs().maxCoeff());
  for (const auto& body : system.bodies)
    if (body.law->needs_deformation()) {
      const double* const volume = body.particles.volume();
      terms += body.law->wave_modulus() * std::accumulate(volume, volume + body.particles.size(), 0.0);
    }
  return of_sums * largest + digit * terms;
}

}  // namespace

template <int Dim>
Monitor<Dim>::Monitor(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, StepSize<Dim>& steps)
    : model_(model), system_(system), stepper_(stepper), steps_(steps) {
  // A body that is drawn by a deformation starts with other volumes than its shape before.
  for (auto& body : system.bodies) {
    VolumeRange range = ordinary_volume(model.materials[static_cast<std::size_t>(body.material)]);
    const VolumeRange start = volume_range(body);
    range.low *= std::min(1.0, start.low), range.high *= std::max(1.0, start.high);
    ranges_.push_back(range);
  }
}

template <int Dim>
std::vector<std::string> Monitor<Dim>::look(double dt, double initial_energy, bool last) {
  Warnings warnings;
  if (!state.is_due(system_.step, dt, model_.time.end) && !last) return warnings;
  const auto lap = watch.lap();
  balance(initial_energy, warnings);
  particles(warnings);
  step(dt, warnings);
  return warnings;
}

template <int Dim>
void Monitor<Dim>::record(Sign sign, const Finding& now, bool worse, Warnings& warnings) {
  if (state.record(sign, now, worse, system_.time)) warnings.push_back(text(sign));
}

template <int Dim>
void Monitor<Dim>::balance(double initial_energy, Warnings& warnings) {
  const Measures all = measure(system_);
  const RunEnergies run = run_energies(model_, system_, stepper_, all);
  const auto gained = [](double x) { return std::max(0.0, x); };
  const double supplied = initial_energy + gained(run.external_work) + gained(run.boundary_work) + gained(run.stages) +
                          gained(-run.potential) + gained(-all.expansion);
  const double residual = energy_residual(all, run, initial_energy);
  const EnergyFigures now{supplied, residual, run.transfer, run.contact, rounding_error(model_, system_, all, run)};
  if (state.record_balance(now, system_.time)) warnings.push_back(text(Sign::energy));
}

template <int Dim>
void Monitor<Dim>::particles(Warnings& warnings) {
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    const ParticleQuality q = particle_quality(system_.bodies[b], system_.lattice, ranges_[b]);
    const auto note = [&](Sign sign, const BadParticles& bad) {
      if (bad.count == 0) return;
      Finding now;
      now.worst = bad.worst, now.count = bad.count, now.place = bad.place, now.body = static_cast<std::int64_t>(b);
      record(sign, now, bad.count > state.of(sign).count, warnings);
    };
    note(Sign::compressed, q.compressed);
    note(Sign::expanded, q.expanded);
    if (static_cast<double>(q.stretched.count) > many * static_cast<double>(system_.bodies[b].particles.size()))
      note(Sign::stretched, q.stretched);
  }
}

template <int Dim>
void Monitor<Dim>::step(double dt, Warnings& warnings) {
  const double joints = stepper_.joints().stable_step(), size = std::min(dt, joints);
  if (!(size < short_step * state.first_step)) return;
  const StepLimit limit = joints < dt ? StepLimit{StepLimit::Cause::joints, -1} : steps_.limit();
  Finding now;
  now.worst = size / state.first_step, now.body = limit.body, now.cause = static_cast<std::int64_t>(limit.cause);
  record(Sign::step, now, now.worst < state.of(Sign::step).worst, warnings);
}

template <int Dim>
std::vector<std::string> Monitor<Dim>::summary() const {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < sign_count; ++k)
    if (state.findings[k].seen) out.push_back(text(static_cast<Sign>(k)));
  for (const std::string& line : expanded_matter(model_, system_)) out.push_back(line);
  if (sudden_gravity(model_).static_slip) out.push_back(sudden_gravity_advice());
  if (const auto removed = static_cast<long long>(system_.deleted_outside); removed > 0)
    out.push_back(format("particles: %lld that left the grid %s removed, with their mass and energy (<LeaveLimit>)",
                         removed, removed == 1 ? "was" : "were"));
  if (const long returned = stepper_.particle_sort().returned; returned > 0)
    out.push_back(
        "particles: " + counted(returned, "time") +
        " one that left the grid was put back at its edge, without its velocity across the edge (<LeaveLimit>)");
  return out;
}

template <int Dim>
std::vector<Figure> Monitor<Dim>::energy_figures() const {
  std::vector<Figure> out = state.energy_figures();
  if (!(state.supplied > 0)) return out;
  for (Figure& figure : out)
    if (figure.is_warning) figure.text += balance_cure();
  double released = 0.0;
  for (const auto& crack : system_.cracks)
    for (const CrackTip& tip : crack.tips) released += tip.released;
  if (state.is_notable(released))
    out.push_back(
        {format("energy: the growth of cracks released %.3g %% of what was supplied; it becomes motion at the "
                "new faces, which transfer and damping dissipate",
                100 * released / state.supplied)});
  return out;
}

// The energy that the balance lacks may be that which a law does not report.
template <int Dim>
std::string Monitor<Dim>::unreported_energy() const {
  for (const auto& body : system_.bodies)
    if (const std::string missing = body.law->unreported_energy(); !missing.empty())
      return "the law of '" + body.name + "' has " + missing + ", so that its energy is missing in the balance";
  return {};
}

template <int Dim>
std::string Monitor<Dim>::balance_cure() const {
  const std::string missing = unreported_energy();
  std::string cure = missing.empty() ? missing : "; " + missing;
  if (const std::string update = cure_of_loss(model_, missing.empty() ? "this loss" : "a further loss");
      !update.empty() && state.residual < 0)
    cure += "; " + update;
  if (missing.empty() && state.residual > 0) cure += "; " + cure_of_excess(model_.scheme);
  return cure;
}

template <int Dim>
std::string Monitor<Dim>::text(Sign sign) const {
  const Finding& f = state.of(sign);
  if (sign == Sign::energy) return energy_text(f);
  return sign == Sign::step ? step_text(f) : particle_text(sign, f);
}

template <int Dim>
std::string Monitor<Dim>::energy_text(const Finding& f) const {
  const std::string missing = unreported_energy();
  return format("energy: %.3g %% of what was supplied came from nowhere until time %.4g: ", 100 * f.worst, f.time) +
         (missing.empty() ? cure_of_gain(model_.scheme) : missing);
}

template <int Dim>
std::string Monitor<Dim>::particle_text(Sign sign, const Finding& f) const {
  const auto& body = system_.bodies[static_cast<std::size_t>(f.body)];
  const VolumeRange ordinary = ranges_[static_cast<std::size_t>(f.body)];
  const std::string who = counted(f.count, "particle") + format(" of '%s' at time %.4g ", body.name.c_str(), f.time);
  const char* const volume =
      "; usually the step is too large, or the shape functions are too rough: a smaller <TimeFactor>, "
      "<GIMP type='quadratic'/>, more particles per cell";
  switch (sign) {
    case Sign::compressed:
      return "volume: " + who + format("below %.3g of their volume, the worst at %.3g at ", ordinary.low, f.worst) +
             place(f) + volume;
    case Sign::expanded:
      return "volume: " + who + format("above %.3g of their volume, the worst at %.3g at ", ordinary.high, f.worst) +
             place(f) + volume;
    default:
      return "holes: " + who + "longer than a cell, the longest " + counted(f.worst, "cell", "%.3g") + " at " +
             place(f) + ": there is less than one per cell, and the body comes apart numerically; " +
             (model_.splitting ? "more 'generations' of <SplitParticles>, or more particles per cell"
                               : "<SplitParticles/>, or more particles per cell");
  }
}

template <int Dim>
std::string Monitor<Dim>::step_text(const Finding& f) const {
  using Cause = StepLimit::Cause;
  const StepLimit limit{static_cast<Cause>(f.cause), f.body};
  const auto cure = [&]() -> const char* {
    switch (limit.cause) {
      case Cause::waves:
      case Cause::faces:
        return "where it is squeezed it gets stiffer; more particles per cell, or larger cells";
      case Cause::speed:
        return "a few particles may have been thrown out; see field 'velocity' of the particle files";
      case Cause::joints:
        return "stiffnesses of a few times modulus over cell size are stiff enough";
      default:
        return "larger cells allow larger steps";
    }
  };
  return format("step: it fell to %.3g of the first one at time %.4g, set by ", f.worst, f.time) + steps_.words(limit) +
         "; " + cure();
}

template <int Dim>
std::string Monitor<Dim>::place(const Finding& f) const {
  std::string at = "(";
  for (int d = 0; d < Dim; ++d) at += (d ? ", " : "") + format("%.4g", f.place[d]);
  return at + ")";
}

template class Monitor<2>;
template class Monitor<3>;

}  // namespace tribo
