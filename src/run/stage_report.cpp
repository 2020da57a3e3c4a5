// SPDX-License-Identifier: MIT
#include "run/stage_report.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "solver/later_particles.hpp"

#include <algorithm>

namespace tribo {

std::string title_of(const StageSpec& stage, int number) {
  return "stage " + std::to_string(number) + (stage.name.empty() ? "" : " '" + stage.name + "'");
}

std::vector<std::string> describe_stages(const Model& model, const Seeds& seeds) {
  std::vector<std::string> out;
  std::vector<LaterSeed> later;
  if (!model.only_blocks()) later = later_seeds(model);
  std::vector<bool> gone(seeds.size(), false);
  for (std::size_t k = 0; k < model.stages.size(); ++k) {
    const StageSpec& stage = model.stages[k];
    const int number = static_cast<int>(k) + 1;
    std::string line = title_of(stage, number) + format(" at time %.6g: ", stage.at) + join(stage.changes);
    long removed = 0;
    for (const StageAction& action : stage.actions) {
      if (action.kind != StageAction::Kind::excavate) continue;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        const bool now = !gone[i] && (action.material < 0 || action.material == seeds[i].material) &&
                         action.where->contains(seeds[i].x);
        removed += now, gone[i] = gone[i] || now;
      }
    }
    const auto placed =
        std::count_if(later.begin(), later.end(), [&](const LaterSeed& seed) { return seed.stage == number; });
    if (removed > 0) line += ", " + counted(removed, "particle") + " of the start excavated";
    if (placed > 0) line += ", " + counted(placed, "particle") + " placed";
    out.push_back(line);
  }
  return out;
}

}  // namespace tribo
