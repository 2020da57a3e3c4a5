// SPDX-License-Identifier: MIT
#include "output/progress.hpp"

#include "base/text.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace tribo {

Progress::Progress(bool quiet, double start, double end, std::int64_t count, std::string kind)
    : quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(start),
      end_(end),
      count_(count),
      kind_(std::move(kind)),
      begin_(Clock::now()),
      last_(begin_) {}

void Progress::step(double time, std::int64_t step, double dt) {
  if (quiet_) return;
  if (first_step_ < 0) first_step_ = step - 1, next_look_ = step;
  if (step < next_look_) return;
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - begin_).count();
  const double rate = static_cast<double>(step - first_step_) / std::max(since, 1e-9);
  next_look_ = step + std::max<std::int64_t>(1, static_cast<std::int64_t>(0.1 * rate));
  if (terminal_) {
    if (now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    line(time, step, dt, false);
  } else if (const int tenth = static_cast<int>(10 * (time - start_) / (end_ - start_)); tenth > tenth_) {
    tenth_ = tenth;
    line(time, step, dt, true);
  }
}

void Progress::line(double time, std::int64_t step, double dt, bool last) {
  const double since = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double part = std::clamp((time - start_) / (end_ - start_), 1e-12, 1.0);
  const double speed = static_cast<double>(count_) * static_cast<double>(step - first_step_) / std::max(since, 1e-9);
  std::fprintf(stderr, "%s%5.1f %%  time %.6g  step %lld  dt %.3g  %.3g M %s-steps/s  %.0f s left%s",
               terminal_ ? "\r" : "", 100 * part, time, static_cast<long long>(step), dt, 1e-6 * speed, kind_.c_str(),
               since * (1 - part) / part, last ? "\n" : "   ");
  std::fflush(stderr);
}

void Progress::finish(double time, std::int64_t step) {
  if (quiet_) return;
  if (terminal_) std::fprintf(stderr, "\r");
  std::fprintf(stderr, "done: time %.6g, %s, %.1f s%40s\n", time, counted(step, "step").c_str(),
               std::chrono::duration<double>(Clock::now() - begin_).count(), "");
}

void Progress::say(const std::string& text) const {
  if (!quiet_) std::fprintf(stderr, "%s\n", (wording ? wording(text) : text).c_str());
}

// Blanks cover the line of progress.
void Progress::warn(const std::string& text) const {
  std::fprintf(stderr, "%swarning: %s%s\n", terminal_ && !quiet_ ? "\r" : "", (wording ? wording(text) : text).c_str(),
               terminal_ && !quiet_ ? std::string(40, ' ').c_str() : "");
}

}  // namespace tribo
