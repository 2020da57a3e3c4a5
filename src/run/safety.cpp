// SPDX-License-Identifier: MIT
#include "run/safety.hpp"

#include <iomanip>
#include <sstream>
#include "materials/material.hpp"

namespace tribo {

Model weakened(const Model& model, double factor) {
  Model weak = model;
  bool any = false;
  for (auto& material : weak.materials) {
    if (!material.law) continue;
    if (auto law = material.law->weakened(factor)) material.law = std::move(law), any = true;
  }
  if (!any)
    throw InputError(model.materials.front().origin,
                     "no material has a strength that could be reduced; MohrCoulomb, DruckerPrager and IsoPlasticity "
                     "have");
  return weak;
}

SafetyTrial judged(double factor, const Settlement& s, double growth, const std::vector<SafetyTrial>& before) {
  static constexpr double most = 5.0;  // of the displacement of the smallest factor that holds
  SafetyTrial trial{factor, s.late, s.at_end, s.failure.empty() && s.at_end <= (1 + growth) * s.late, s.failure};
  const SafetyTrial* first = nullptr;
  for (const auto& t : before)
    if (t.holds && t.factor < factor && (!first || t.factor < first->factor)) first = &t;
  if (!trial.holds || !first || !(s.at_end > most * first->at_end)) return trial;
  std::ostringstream why;
  why << std::setprecision(3) << "it came to rest with a displacement " << s.at_end / first->at_end
      << " times that with strengths over " << first->factor << ", more than " << most << " times: a collapse";
  trial.holds = false, trial.failure = why.str();
  return trial;
}

Safety find_safety(const Model& model, int threads, const std::function<void(const SafetyTrial&)>& report) {
  static constexpr double least = 0.1, most = 100.0, widen = 1.5;
  const StrengthReduction& search = model.strength_reduction;
  Safety safety;
  const auto holds = [&](double factor) {
    const Settlement s = settle(weakened(model, factor), threads);
    safety.trials.push_back(judged(factor, s, search.growth, safety.trials));
    report(safety.trials.back());
    return safety.trials.back().holds;
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
