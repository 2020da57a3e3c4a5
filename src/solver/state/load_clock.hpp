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
  double ended = -1.0;   ///< time at which the lower value was passed on the way back; negative: not yet
  bool watched = false;  ///< whether the quantity has been seen
  double last = 0.0;     ///< its last value

  bool is_turned() const { return turned >= 0; }
  /// Whether cracks have stopped growing, because one of them has reached the length of the reversal.
  bool is_arrested(const std::optional<LoadReversal>& reversal) const {
    return reversal && reversal->crack && is_turned();
  }
  /// Load time at a time of the run.
  double at(double time, const std::optional<LoadReversal>& reversal) const {
    if (!reversal || !acts(time, *reversal)) return time;
    if (!goes_back(time, *reversal)) return turned;
    return std::max(0.0, 2 * turned + reversal->hold - time);
  }
  /// Rate of the load time: 1, or after the reversal -1 or 0.
  double rate(double time, const std::optional<LoadReversal>& reversal) const {
    if (!reversal || !acts(time, *reversal)) return 1.0;
    return goes_back(time, *reversal) && time < 2 * turned + reversal->hold ? -1.0 : 0.0;
  }
  /// End of a run that would end at `end`.
  double end_of_run(double end, const std::optional<LoadReversal>& reversal) const {
    if (!reversal || !is_turned()) return end;
    if (reversal->style == Style::stop) return std::min(end, turned);
    if (reversal->style != Style::reverse) return end;
    return std::min(end, ended >= 0 ? ended : 2 * turned + reversal->hold);
  }
  /// Looks at a value of the quantity at a time. Returns whether it has just passed the value of the reversal.
  bool look(double value, double time, const LoadReversal& reversal) {
    const auto passes = [&](double limit) {
      return watched && ((last < limit && value >= limit) || (last > limit && value <= limit));
    };
    const bool turns = !is_turned() && passes(reversal.value);
    if (is_turned() && ended < 0 && reversal.least && goes_back(time, reversal) && passes(*reversal.least))
      ended = time;
    watched = true, last = value;
    if (turns) turned = time;
    return turns;
  }

 private:
  using Style = LoadReversal::Style;
  bool acts(double time, const LoadReversal& reversal) const {
    return reversal.style != Style::none && is_turned() && time > turned;
  }
  bool goes_back(double time, const LoadReversal& reversal) const {
    return reversal.style == Style::reverse && time > turned + reversal.hold;
  }
};

inline void archive(Archive& a, LoadClock& clock) {
  a.version(2);
  a("turned", clock.turned), a("ended", clock.ended), a("watched", clock.watched), a("last", clock.last);
}

}  // namespace tribo
