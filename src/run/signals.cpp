// SPDX-License-Identifier: MIT
#include "run/signals.hpp"

#include "run/simulation.hpp"

#include <atomic>
#include <csignal>
#include <filesystem>

namespace tribo {
namespace {

std::atomic<bool> stop_requested{false}, checkpoint_requested{false};

void handle(int) { stop_requested = true; }

}  // namespace

SignalGuard::SignalGuard() {
  stop_requested = checkpoint_requested = false;
  old_user_ = std::signal(SIGUSR1, [](int) { checkpoint_requested = true; });
  old_interrupt_ = std::signal(SIGINT, handle);
  old_terminate_ = std::signal(SIGTERM, handle);
}

SignalGuard::~SignalGuard() {
  std::signal(SIGUSR1, old_user_);
  std::signal(SIGINT, old_interrupt_);
  std::signal(SIGTERM, old_terminate_);
}

bool SignalGuard::stop() const { return stop_requested; }
bool SignalGuard::checkpoint() const { return checkpoint_requested; }
void SignalGuard::checkpoint_done() { checkpoint_requested = false; }

void request_stop() { stop_requested = true; }

std::string source_of(const Model& model) {
  std::string out = std::filesystem::absolute(model.file).string() + "\n";
  for (const auto& [name, value] : model.settings) {
    out += name;
    out += "=" + value + "\n";
  }
  return out;
}

}  // namespace tribo
