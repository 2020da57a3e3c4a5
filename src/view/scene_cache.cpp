// SPDX-License-Identifier: MIT
#include "view/scene_cache.hpp"

#include "view/picture.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr std::size_t most_kept = 8, most_particles = 4000000;

// The distance of neighbours; of many particles, of those in a box in their middle.
double spacing_in(const ParticleFrame& frame, const std::array<std::array<double, 3>, 2>& box) {
  static constexpr std::size_t many = 400000;
  if (frame.count() <= many) return spacing_of(frame.position);
  const double share = std::cbrt(static_cast<double>(many) / static_cast<double>(frame.count()));
  const auto& centre = frame.position[frame.count() / 2];
  std::vector<std::array<double, 3>> some;
  for (const auto& x : frame.position) {
    bool inside = true;
    for (std::size_t d = 0; d < 3; ++d)
      inside = inside && std::abs(x[d] - centre[d]) <= 0.5 * share * (box[1][d] - box[0][d]);
    if (inside) some.push_back(x);
  }
  return some.size() > 1000 ? spacing_of(some) : spacing_of(frame.position);
}

std::shared_ptr<const KnownScene> known(Scene scene) {
  KnownScene out;
  out.scene = std::move(scene);
  if (out.scene.particles.count() + out.scene.blocks.count() > 0) out.box = box_of(out.scene);
  out.flat = out.box[1][2] - out.box[0][2] <= 0;
  out.spacing = spacing_in(out.scene.particles, out.box);
  return std::make_shared<const KnownScene>(std::move(out));
}

}  // namespace

std::shared_ptr<const KnownScene> SceneCache::scene(std::size_t k) {
  const auto frames = run_.frames();
  if (k >= frames.size()) throw FileError("there is no such file yet");
  const CollectionEntry& entry = frames[k];
  std::error_code gone;
  const auto written = std::filesystem::last_write_time(entry.file, gone);
  const std::scoped_lock lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) {
    return one.entry.file == entry.file && one.entry.time == entry.time && one.written == written;
  });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
  } else {
    kept_.push_front({entry, written, known(run_.scene(entry))});
  }
  // The latest one always stays.
  std::size_t particles = 0, count = 0;
  for (auto one = kept_.begin(); one != kept_.end();) {
    particles += one->scene->scene.particles.count();
    one = count > 0 && (count >= most_kept || particles > most_particles) ? kept_.erase(one) : std::next(one);
    ++count;
  }
  return kept_.front().scene;
}

}  // namespace tribo
