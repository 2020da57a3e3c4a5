// SPDX-License-Identifier: MIT
/// Accumulated wall-clock time of repeated sections.
#pragma once

#include <chrono>

namespace tribo {

class Stopwatch {
 public:
  /// Measures from its construction to the end of its scope.
  class Lap {
   public:
    explicit Lap(Stopwatch& watch) : watch_(watch), begin_(Clock::now()) {}
    ~Lap() { watch_.seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Stopwatch& watch_;
    std::chrono::steady_clock::time_point begin_;
  };
  [[nodiscard]] Lap lap() { return Lap(*this); }
  double seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds_ = 0.0;
};

}  // namespace tribo
