// SPDX-License-Identifier: MIT
#include "run/safety.hpp"

#include "materials/material.hpp"
#include "run/simulation.hpp"

#include <sstream>

namespace tribo {

Model weakened(const Model& model, double factor) {
  Model weak = model;
  bool any = false;
  for (auto& material : weak.materials) {
    if (!material.law) continue;
    if (auto law = material.law->weakened(factor)) material.law = std::move(law), any = true;
  }
  if (!any)
    throw InputError(
        model.materials.front().origin,
        "no material has a strength that could be reduced; MohrCoulomb, DruckerPrager, IsoPlasticity and "
        "IsoSoftening have one; for joints make friction and cohesion variables of the file and use 'tribo sweep'");
  return weak;
}

std::string doubt_about(const Safety& safety) {
  static constexpr double doubtful = 10.0;
  const SafetyTrial* strongest = nullptr;
  const SafetyTrial* weakest = nullptr;
  for (const auto& t : safety.trials)
    if (t.holds) {
      if (!strongest || t.factor < strongest->factor) strongest = &t;
      if (!weakest || t.factor > weakest->factor) weakest = &t;
    }
  if (!strongest || !(weakest->at_end > doubtful * strongest->at_end)) return "";
  std::ostringstream out;
  out.precision(3);
  out << "with strengths over " << weakest->factor << " the model came to rest after a displacement of "
      << weakest->at_end << ", " << weakest->at_end / strongest->at_end << " times that with strengths over "
      << strongest->factor
      << ": it may have collapsed. Look at its pictures; <StrengthReduction displacement='...'/> says which "
         "displacement is a failure";
  return out.str();
}

Safety find_safety(const Model& model, int threads, const std::function<void(const SafetyTrial&)>& report) {
  static constexpr double least = 0.1, most = 100.0, widen = 1.5;
  const StrengthReduction& search = model.strength_reduction;
  if (!model.stages.empty())
    throw InputError(model.stages.front().origin,
                     "the factor of safety is that of a model without stages: leave out <Stage>");
  Safety safety;
  const auto holds = [&](double factor) {
    const Settlement s = settle(weakened(model, factor), threads);
    const bool still = s.failure.empty() && s.at_end <= (1 + search.growth) * s.late &&
                       !(search.displacement && s.at_end > *search.displacement);
    safety.trials.push_back({factor, s.late, s.at_end, still, s.failure});
    report(safety.trials.back());
    return still;
  };

  safety.holds = search.low, safety.slips = search.high;
  bool low_known = false, high_known = false;
  while (!low_known) {
    if ((low_known = holds(safety.holds))) break;
    safety.slips = safety.holds, high_known = true;
    if (safety.holds <= least)
      throw SimulationError("the model slips even with strengths divided by " + std::to_string(safety.holds) +
                            ": is everything held that should be, and does it come to rest within the run?");
    safety.holds = std::max(least, safety.holds / widen);
  }
  while (!high_known) {
    if ((high_known = !holds(safety.slips))) break;
    safety.holds = safety.slips;
    if (safety.slips >= most)
      throw SimulationError("the model holds even with strengths divided by " + std::to_string(safety.slips) +
                            ": does anything load it?");
    safety.slips = std::min(most, safety.slips * widen);
  }
  while (safety.slips - safety.holds > search.tolerance) {
    const double middle = 0.5 * (safety.holds + safety.slips);
    if (!(middle > safety.holds && middle < safety.slips)) break;  // no floating-point number lies between them
    (holds(middle) ? safety.holds : safety.slips) = middle;
  }
  return safety;
}

}  // namespace tribo
