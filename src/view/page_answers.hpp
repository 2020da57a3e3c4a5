// SPDX-License-Identifier: MIT
/// Answers to the requests of the live page, all from the files of the run.
#pragma once

#include "view/frame_answer.hpp"
#include "view/picked.hpp"

#include <string>

namespace tribo {

class PageAnswers {
 public:
  explicit PageAnswers(const RunFolder& run) : run_(run), cache_(run) {}

  /// The record of the run, its folder and the times of its files.
  std::string state() const;
  /// See frame_answer().
  std::string frame(std::size_t k, const FrameRequest& request);
  /// A picture that the program draws, for browsers without WebGL.
  std::string image(std::size_t k, const std::string& field);
  /// The range of a field and the box around all bodies over the run, from up to a dozen of its files.
  std::string range(const std::string& field) const;
  /// Histories and energies with their units, thinned if they are long.
  std::string tables() const;
  /// Charts of them that the program draws.
  std::string charts() const;
  /// What the model has besides particles and blocks: walls, conditions, cracks, grid; an empty list for a run.
  std::string layers() const;
  /// Values of a particle by its index in file `k`, or of a block by its number and of the contact next to a point.
  std::string particle(std::size_t k, std::size_t index);
  std::string block(std::size_t k, double number, const std::array<double, 3>& point);
  std::string values(std::size_t k, const Picked& what);
  std::string history(const Picked& what) const;
  /// Sends a signal to the run; false if it does not run.
  bool tell(int signal) const;

 private:
  // The particles to draw, found anew only for another state or another choice.
  std::shared_ptr<const Drawn> drawn_of(const std::shared_ptr<const KnownScene>& known, const Wanted& wanted);

  const RunFolder& run_;
  SceneCache cache_;
  std::mutex mutex_;
  struct {
    std::shared_ptr<const KnownScene> scene;
    Wanted wanted;
    std::shared_ptr<const Drawn> drawn;
  } last_;
};

}  // namespace tribo
