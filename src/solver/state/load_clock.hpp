// SPDX-License-Identifier: MIT
/// The time at which loads and the motion of rigid bodies are evaluated. It can stop, or run backwards.
#pragma once

#include "base/archive.hpp"
#include "model/model.hpp"

#include <algorithm>

namespace tribo {

/// Until a quantity of the histories passes the value of the model's load reversal, the load time is the time.
struct LoadClock {
  double turned = -1.0;  ///< time at which the value was passed; negative: not yet
  bool watched = false;  ///< whether the quantity has been seen
  double last = 0.0;     ///< its last value

  bool is_turned() const { return turned >= 0; }
  /// Load time at a time of the run.
  double at(double time, const std::optional<LoadReversal>& reversal) const {
    if (!reversal || !is_turned() || time <= turned) return time;
    return reversal->style == LoadReversal::Style::reverse ? std::max(0.0, 2 * turned - time) : turned;
  }
  /// Rate of the load time: 1, or after the reversal -1 or 0.
  double rate(double time, const std::optional<LoadReversal>& reversal) const {
    if (!reversal || !is_turned() || time <= turned) return 1.0;
    return reversal->style == LoadReversal::Style::reverse && time < 2 * turned ? -1.0 : 0.0;
  }
  /// End of a run that would end at `end`.
  double end_of_run(double end, const std::optional<LoadReversal>& reversal) const {
    if (!reversal || !is_turned() || reversal->style == LoadReversal::Style::hold) return end;
    return std::min(end, reversal->style == LoadReversal::Style::stop ? turned : 2 * turned);
  }
  /// Looks at a value of the quantity at a time. Returns whether it has just passed the value of the reversal.
  bool look(double value, double time, const LoadReversal& reversal) {
    const bool passed =
        watched && !is_turned() &&
        ((last < reversal.value && value >= reversal.value) || (last > reversal.value && value <= reversal.value));
    watched = true, last = value;
    if (passed) turned = time;
    return passed;
  }
};

inline void archive(Archive& a, LoadClock& clock) {
  auto& [turned, watched, last] = clock;
  a.version(1);
  a("turned", turned), a("watched", watched), a("last", last);
}

}  // namespace tribo
