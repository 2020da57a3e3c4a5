// SPDX-License-Identifier: MIT
/// What a run has noticed about its own results; part of its checkpoint.
#pragma once

#include "base/archive.hpp"
#include "base/types.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tribo {

/// Signs that the results of a run are wrong.
enum class Sign { energy, compressed, expanded, stretched, step };
inline constexpr std::size_t sign_count = 5;

/// What is known of one sign.
struct Finding {
  bool seen = false;
  double first = 0.0;  ///< when it was seen first                               [time]
  double time = 0.0;   ///< when it was worst                                    [time]
  double worst = 0.0;  ///< energy: gain over what was supplied; volume ratio; length [cells]; step over the first one
  std::int64_t count = 0;     ///< of particles, when it was worst
  std::int64_t body = -1;     ///< index into System::bodies
  std::int64_t cause = 0;     ///< step: StepLimit::Cause
  Vec3 place = Vec3::Zero();  ///< of the worst particle                         [length]
};

inline void archive(Archive& a, Finding& finding) {
  auto& [seen, first, time, worst, count, body, cause, place] = finding;
  a.version(1);
  a("seen", seen), a("first", first), a("time", time), a("worst", worst);
  a("count", count), a("body", body), a("cause", cause), a("place", place);
}

/// A figure of the balance of energy, as a line.
struct Figure {
  std::string text;
  bool is_warning = false;  ///< whether energy is not accounted for
};

/// The balance of energy of a run at one time [energy].
struct EnergyFigures {
  double supplied = 0.0;  ///< so far
  double residual = 0.0;  ///< what is not accounted for
  double transfer = 0.0;  ///< dissipated by the transfers between particles and grid; negative: created
  double contact = 0.0;   ///< dissipated by contact without interface laws; negative: created
  double rounding = 0.0;  ///< error of these figures that rounding explains
};

struct MonitorState {
  static constexpr double noticed = 0.02;  ///< share of the energy supplied that is worth a line

  std::int64_t stride = 0;  ///< steps between two looks; 0: not yet known
  double first_step = 0.0;  ///< size of the first step                        [time]
  double supplied = 0.0;    ///< energy that was supplied so far               [energy]
  double gain = 0.0;        ///< energy from nowhere at the last look: residual and what was created [energy]
  double residual = 0.0;    ///< of the energy balance at the last look        [energy]
  double transfer = 0.0;    ///< dissipated by the transfers until then; negative: created [energy]
  double contact = 0.0;     ///< dissipated by contact until then; negative: created [energy]
  double rounding = 0.0;    ///< error of the balance that rounding explains, the largest so far [energy]
  std::int64_t gains = 0;   ///< looks in a row with a gain
  std::array<Finding, sign_count> findings{};
  Finding& of(Sign sign) { return findings[static_cast<std::size_t>(sign)]; }
  const Finding& of(Sign sign) const { return findings[static_cast<std::size_t>(sign)]; }

  /// Whether the run is to be looked at after this step of size dt [time]; `end`: of the run [time].
  bool is_due(std::int64_t step, double dt, double end);
  /// Notes a sign, with its figures where it is worst so far. True if it is seen for the first time.
  bool record(Sign sign, const Finding& now, bool worse, double time);
  /// Notes the balance of energy at a time. True if it is seen for the first time that energy comes from nowhere.
  bool record_balance(const EnergyFigures& now, double time);
  /// Whether an energy is more than a trifle of what was supplied, and more than rounding explains.
  bool is_notable(double energy) const { return energy > noticed * supplied && energy > rounding; }
  /// Lines on the energy that transfers and contact dissipated or created and on what is missing, where they are more
  /// than a trifle.
  std::vector<Figure> energy_figures() const;
};

inline void archive(Archive& a, MonitorState& state) {
  auto& [stride, first_step, supplied, gain, residual, transfer, contact, rounding, gains, findings] = state;
  a.version(4);
  a("stride", stride), a("first_step", first_step), a("supplied", supplied), a("gain", gain), a("gains", gains);
  a("residual", residual), a("transfer", transfer), a("contact", contact), a("rounding", rounding);
  a.each("finding", findings);
}

}  // namespace tribo
