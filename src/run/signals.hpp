// SPDX-License-Identifier: MIT
/// Signals that ask a run to stop or to write a checkpoint.
#pragma once

#include "model/model.hpp"

#include <string>

namespace tribo {

/// Turns SIGINT or SIGTERM into a request to stop, SIGUSR1 into one for a checkpoint; restores the old handlers
/// afterwards.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

  bool stop() const;
  bool checkpoint() const;
  void checkpoint_done();

 private:
  void (*old_interrupt_)(int);
  void (*old_terminate_)(int);
  void (*old_user_)(int);
};

/// The path of the command file, then one line per variable set from outside; 'tribo resume' reads it.
std::string source_of(const Model& model);

}  // namespace tribo
