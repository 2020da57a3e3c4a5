// SPDX-License-Identifier: MIT
#include "run/signals.hpp"

#include "run/simulation.hpp"

#include <atomic>
#include <csignal>

namespace tribo {
namespace {

std::atomic<bool> stop_requested{false}, checkpoint_requested{false};

int guards = 0;

void handle(int) { stop_requested = true; }

}  // namespace

SignalGuard::SignalGuard() {
  if (guards++ > 0) return;
  stop_requested = checkpoint_requested = false;
  old_.push_back({SIGUSR1, std::signal(SIGUSR1, [](int) { checkpoint_requested = true; })});
  // A file beyond the limit of the user (ulimit -f) is then a failed write, which is reported like a full disk.
  old_.push_back({SIGXFSZ, std::signal(SIGXFSZ, SIG_IGN)});
  for (const int signal : {SIGINT, SIGTERM}) old_.push_back({signal, std::signal(signal, handle)});
  for (const int signal : {SIGHUP, SIGPIPE}) {
    void (*const old)(int) = std::signal(signal, SIG_IGN);
    if (old == SIG_IGN) continue;
    old_.push_back({signal, old});
    std::signal(signal, handle);
  }
}

SignalGuard::~SignalGuard() {
  --guards;
  for (const Old& old : old_) std::signal(old.signal, old.handler);
}

void heed_stop() {
  if (guards > 0 && stop_requested) throw StopRequest{};
}

bool SignalGuard::stop() { return stop_requested; }
bool SignalGuard::checkpoint() { return checkpoint_requested; }
void SignalGuard::checkpoint_done() { checkpoint_requested = false; }

void request_stop() { stop_requested = true; }

}  // namespace tribo
