// SPDX-License-Identifier: MIT
/// Progress of a run on the terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace tribo {

/// One updating line on a terminal, a line per tenth of the run elsewhere, nothing if quiet.
class Progress {
 public:
  /// `count` objects of a `kind`, such as `particle`, move in every step; for the speed that is shown.
  Progress(bool quiet, double start, double end, std::int64_t count, std::string kind);
  /// Call once per step. Reads the clock only in some of them.
  void step(double time, std::int64_t step, double dt);
  void finish(double time, std::int64_t step);
  /// A line of the summary; nothing if quiet.
  void say(const std::string& text) const;
  /// A warning, also if quiet.
  void warn(const std::string& text) const;
  /// Applied to the text of every line of the summary and every warning; empty: they are printed as they are.
  std::function<std::string(const std::string&)> wording;

 private:
  using Clock = std::chrono::steady_clock;
  void line(double time, std::int64_t step, double dt, bool last);

  bool quiet_, terminal_;
  double start_, end_;
  std::int64_t count_, first_step_ = -1, next_look_ = 0;
  int tenth_ = 0;
  std::string kind_;
  Clock::time_point begin_, last_;
};

}  // namespace tribo
