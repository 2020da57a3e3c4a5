// SPDX-License-Identifier: MIT
/// A local web page that shows a run in progress.
#pragma once

#include "view/run_folder.hpp"

#include <functional>

namespace tribo {

struct WatchOptions {
  int port = 0;  ///< 0: any that is free
  /// Called with the address once the server accepts connections.
  std::function<void(const std::string&)> ready;
};

/// Serves the page to this machine only, at an address with a random word, until SIGINT, SIGTERM or SIGHUP. The page
/// can ask the run to stop, or to write a checkpoint. Throws FileError if the port is taken.
void watch(const RunFolder& run, const WatchOptions& options);

}  // namespace tribo
