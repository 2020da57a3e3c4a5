// SPDX-License-Identifier: MIT
/// Signals that ask a run to stop or to write a checkpoint.
#pragma once

#include <vector>

namespace tribo {

/// Turns SIGINT, SIGTERM, SIGHUP (the terminal was closed) and SIGPIPE (the reader of the output has gone) into a
/// request to stop, SIGUSR1 into one for a checkpoint; the outermost guard restores the old handlers. SIGHUP and
/// SIGPIPE that are ignored, as under nohup, remain so.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

  /// Whether the present guards have heard such a request.
  static bool stop();
  static bool checkpoint();
  static void checkpoint_done();

 private:
  struct Old {
    int signal;
    void (*handler)(int);
  };
  std::vector<Old> old_;
};

/// Thrown where there is no checkpoint to write: a request to stop.
struct StopRequest {};
/// Throws StopRequest if a guard has heard a request to stop.
void heed_stop();

}  // namespace tribo
