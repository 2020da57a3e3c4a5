// SPDX-License-Identifier: MIT
/// States of a run that the live page has asked for lately.
#pragma once

#include "view/run_folder.hpp"

#include <list>
#include <memory>
#include <mutex>

namespace tribo {

/// A state with what is found once for all answers about it.
struct KnownScene {
  Scene scene;
  std::array<std::array<double, 3>, 2> box{};  ///< around particles and blocks; zero if there are none
  double spacing = 0.0;                        ///< distance of neighbouring particles [length]
  bool flat = true;                            ///< all in a plane normal to z
};

/// Keeps the states read last, since the page asks for the same one with other fields, sections or arrows. Several
/// threads may call it.
class SceneCache {
 public:
  explicit SceneCache(const RunFolder& run) : run_(run) {}

  /// State `k` of the run. Throws FileError if there is none yet.
  std::shared_ptr<const KnownScene> scene(std::size_t k);
  const RunFolder& run() const { return run_; }

 private:
  struct Kept {
    CollectionEntry entry;
    std::filesystem::file_time_type written;
    std::shared_ptr<const KnownScene> scene;
  };
  const RunFolder& run_;
  std::mutex mutex_;
  std::list<Kept> kept_;  // the latest first
};

}  // namespace tribo
