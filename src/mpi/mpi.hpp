// SPDX-License-Identifier: MIT
/// Runs in several processes by MPI, with the blocks of the grid divided by p4est.
#pragma once

#include <memory>

namespace tribo {

/// MPI and p4est while it lives. From its construction on, ranks() are all processes of the launcher.
class MpiSession {
 public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// Ends all processes at once, with an exit code.
  [[noreturn]] static void abort(int code);

 private:
  class Processes;
  std::unique_ptr<Processes> processes_;
};

}  // namespace tribo
