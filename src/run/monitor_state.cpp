// SPDX-License-Identifier: MIT
#include "run/monitor_state.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

/// A look costs a fraction of a step, and a run has about this many of them, but none more often than every
/// `least_stride` steps.
constexpr double looks_per_run = 50;
constexpr std::int64_t least_stride = 20;
/// Share of the supplied energy; gains above it are warned of, other figures are told.
/// A gain must last for so many looks.
constexpr std::int64_t lasting = 5;

}  // namespace

bool MonitorState::is_due(std::int64_t step, double dt, double end) {
  if (stride == 0) {
    first_step = dt;
    stride = std::max(least_stride, static_cast<std::int64_t>(end / dt / looks_per_run));
  }
  return step % stride == 0;
}

bool MonitorState::record(Sign sign, const Finding& now, bool worse, double at) {
  Finding& f = of(sign);
  const bool fresh = !f.seen;
  const double since = fresh ? at : f.first;
  if (fresh || worse) f = now, f.seen = true, f.first = since, f.time = at;
  return fresh;
}

bool MonitorState::record_balance(const EnergyFigures& now, double at) {
  supplied = std::max(supplied, now.supplied), rounding = std::max(rounding, now.rounding);
  residual = now.residual, transfer = now.transfer, contact = now.contact;
  gain = residual - transfer + std::max(0.0, -contact);
  gains = supplied > 0 && is_notable(gain) ? gains + 1 : 0;
  if (gains < lasting) return false;
  Finding found;
  found.worst = gain / supplied;
  return record(Sign::energy, found, found.worst > of(Sign::energy).worst, at);
}

std::vector<Figure> MonitorState::energy_figures() const {
  std::vector<Figure> out;
  const auto tell = [&](const char* what, double energy, bool is_warning) {
    if (is_notable(std::abs(energy)))
      out.push_back(
          {format("energy: %s %.3g %% of what was supplied", what, 100 * std::abs(energy) / supplied), is_warning});
  };
  if (!(supplied > 0)) return out;
  tell(transfer > 0 ? "the transfer between particles and grid dissipated"
                    : "the transfer between particles and grid created",
       transfer, false);
  if (contact < 0) tell("contact created", contact, false);
  tell(residual < 0 ? "the balance lacks" : "the balance exceeds by", residual, true);
  return out;
}

}  // namespace tribo
