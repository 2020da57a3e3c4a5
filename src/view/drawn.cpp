// SPDX-License-Identifier: MIT
#include "view/drawn.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace tribo {
namespace {

using Place = std::array<double, 3>;

bool cut_away(const Place& x, const std::vector<Section>& sections) {
  return std::any_of(sections.begin(), sections.end(), [&](const Section& s) { return s.leaves_out(x); });
}

// Cells of a regular lattice over the particles, each with a key of 64 bits.
class Boxes {
 public:
  Boxes(const Place& low, double size) : low_(low), size_(size) {}
  std::uint64_t key(const Place& x, int dx = 0, int dy = 0, int dz = 0) const {
    return part(x, 0, dx) << 42U | part(x, 1, dy) << 21U | part(x, 2, dz);
  }

 private:
  std::uint64_t part(const Place& x, std::size_t d, int shift) const {
    const double k = std::floor((x[d] - low_[d]) / size_) + 1 + shift;
    return static_cast<std::uint64_t>(std::clamp(k, 0.0, 2097151.0));
  }
  Place low_;
  double size_;
};

Place low_corner(const std::vector<Place>& places, const std::vector<std::uint32_t>& list) {
  Place low = places[list.front()];
  for (const auto i : list)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], places[i][d]);
  return low;
}

// The particles that are not surrounded: of the 26 boxes around theirs, one is empty.
std::vector<std::uint32_t> surface(const ParticleFrame& frame, const std::vector<std::uint32_t>& list, double size) {
  const Boxes boxes(low_corner(frame.position, list), size);
  std::unordered_map<std::uint64_t, bool> open;
  open.reserve(list.size());
  for (const auto i : list) open.emplace(boxes.key(frame.position[i]), false);
  std::vector<std::uint32_t> out;
  std::unordered_map<std::uint64_t, bool> done;
  done.reserve(open.size());
  for (const auto i : list) {
    const Place& x = frame.position[i];
    const auto [found, fresh] = done.emplace(boxes.key(x), false);
    for (int k = 0; fresh && k < 27 && !found->second; ++k)
      found->second = !open.contains(boxes.key(x, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
    if (found->second) out.push_back(i);
  }
  return out;
}

}  // namespace

std::vector<std::uint32_t> thinned(const std::vector<Place>& places, const std::vector<std::uint32_t>& list,
                                   std::size_t most, double& size) {
  if (list.size() <= most) return list;
  const Place low = low_corner(places, list);
  for (;; size *= 1.1) {
    const Boxes boxes(low, size);
    std::unordered_map<std::uint64_t, std::uint32_t> first;
    first.reserve(2 * most);
    for (const auto i : list) {
      first.emplace(boxes.key(places[i]), i);
      if (first.size() > most) break;
    }
    if (first.size() > most) continue;
    std::vector<std::uint32_t> out;
    for (const auto& [key, i] : first) out.push_back(i);
    std::sort(out.begin(), out.end());
    return out;
  }
}

Drawn drawn(const KnownScene& known, const Wanted& wanted) {
  const ParticleFrame& frame = known.scene.particles;
  Drawn out;
  const auto *material = frame.field("material"), *body = frame.field("body");
  const auto hides = [](const std::set<int>& hidden, const ParticleFrame::Field* field, std::size_t i) {
    return field && hidden.contains(static_cast<int>(field->values[i]));
  };
  for (std::size_t i = 0; i < frame.count(); ++i)
    if (!cut_away(frame.position[i], wanted.sections) && !hides(wanted.hidden, material, i) &&
        !hides(wanted.hidden_bodies, body, i))
      out.particles.push_back(static_cast<std::uint32_t>(i));
  out.visible = out.particles.size();
  if (out.particles.empty()) return out;
  static constexpr std::size_t few = 2000;
  if (!(known.spacing > 0)) return out;
  if (!known.flat && out.visible > few) {
    out.particles = surface(frame, out.particles, 1.5 * known.spacing);
    out.inside = out.visible - out.particles.size();
  }
  const std::size_t most = std::max<std::size_t>(1, wanted.most), count = out.particles.size();
  if (count > most) {
    // The particles that remain in space are a surface.
    double size = known.spacing * std::sqrt(static_cast<double>(count) / static_cast<double>(most));
    out.particles = thinned(frame.position, out.particles, most, size);
    out.growth = std::max(1.0, 1.1 * size / known.spacing);
  }
  return out;
}

CellFrame visible_cells(const CellFrame& cells, const Wanted& wanted) {
  const auto* group = cells.field("group");
  CellFrame out;
  out.time = cells.time, out.position = cells.position;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < cells.count(); ++c) {
    if (group && wanted.hidden_groups.contains(static_cast<int>(group->values[c]))) continue;
    Place centre{};
    for (const auto k : cells.cells[c])
      for (std::size_t d = 0; d < 3; ++d)
        centre[d] += cells.position[k][d] / static_cast<double>(cells.cells[c].size());
    if (!cut_away(centre, wanted.sections)) kept.push_back(c), out.cells.push_back(cells.cells[c]);
  }
  for (const auto& field : cells.fields) {
    out.fields.push_back({field.name, field.components, field.integers, {}});
    const auto n = static_cast<std::size_t>(field.components);
    for (const std::size_t c : kept)
      for (std::size_t d = 0; d < n; ++d) out.fields.back().values.push_back(field.values[c * n + d]);
  }
  return out;
}

}  // namespace tribo
