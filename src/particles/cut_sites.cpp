// SPDX-License-Identifier: MIT
#include "particles/cut_sites.hpp"

#include "base/parallel.hpp"

#include <queue>

namespace tribo {
namespace {

constexpr double least_part = 0.3;  // of a cell; smaller parts are joined with a neighbour

// Whether all neighbours of a site, also the diagonal ones, have the same flag as the site.
bool is_uniform(const Sites& lattice, const std::vector<bool>& flags, std::size_t site) {
  const int dimension = lattice.flat ? 2 : 3;
  const bool flag = flags[site];
  const auto row = [&](auto&& self, std::size_t at, int axis) -> bool {
    if (axis == dimension) return flags[at] == flag;
    if (!self(self, at, axis + 1)) return false;
    for (const int side : {-1, 1}) {
      const auto next = lattice.neighbour(at, static_cast<std::size_t>(axis), side);
      if (next ? !self(self, *next, axis + 1) : flag) return false;
    }
    return true;
  };
  return row(row, site, 0);
}

}  // namespace

CutSites::CutSites(const Sites& lattice, const Bounds& reach, const std::vector<bool>& centres,
                   const std::function<bool(const Vec3&)>& inside, bool all)
    : lattice_(lattice), whole_(centres) {
  using Places = std::vector<std::pair<std::size_t, Vec3>>;
  std::vector<Places> of_layer(static_cast<std::size_t>(lattice.layers(reach)));
  parallel_for(static_cast<std::ptrdiff_t>(of_layer.size()), [&](std::ptrdiff_t layer) {
    lattice.visit_layer(reach, layer, [&](const Vec3& x, std::size_t site) {
      if (all || !is_uniform(lattice, centres, site)) of_layer[static_cast<std::size_t>(layer)].emplace_back(site, x);
    });
  });
  Places examined;
  for (const Places& places : of_layer) examined.insert(examined.end(), places.begin(), places.end());
  std::vector<std::optional<CutCell>> parts(examined.size());
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const CutCell whole = box(examined[static_cast<std::size_t>(k)].second);
    parts[static_cast<std::size_t>(k)] = cut_cell(inside, whole.low, whole.high, lattice.flat, all ? 9 : 3);
  });
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto& [site, x] = examined[k];
    const double whole = box(x).volume;
    centre_of_[site] = x;
    whole_[site] = parts[k] && parts[k]->volume >= (1 - 1e-9) * whole;
    if (parts[k] && !whole_[site] && parts[k]->volume > 1e-9 * whole) cut_[site] = std::move(*parts[k]);
  }
  join_small_parts();
}

CutCell CutSites::box(const Vec3& centre) const {
  Vec3 half = 0.5 * lattice_.spacing;
  if (lattice_.flat) half[2] = 0.5;
  return whole_cell(centre - half, centre + half);
}

// The neighbour with a particle at the largest open side of a cell; none if there is no such neighbour.
std::optional<std::size_t> CutSites::best_neighbour(std::size_t site, const CutCell& cell) const {
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t k = 0; k < (lattice_.flat ? 4u : 6u); ++k) {
    const auto next = lattice_.neighbour(site, k / 2, k % 2 == 0 ? -1 : 1);
    if (!next || !(cell.open_areas[k] > most) || !(whole_[*next] || cut_.count(*next) != 0)) continue;
    best = next, most = cell.open_areas[k];
  }
  return best;
}

void CutSites::join_small_parts() {
  using Entry = std::pair<double, std::size_t>;  // volume and site, the smallest first
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> small;
  const auto limit = [&] {
    Vec3 size = lattice_.spacing;
    if (lattice_.flat) size[2] = 1.0;
    return least_part * size.prod();
  }();
  for (const auto& [site, cell] : cut_)
    if (cell.volume < limit) small.emplace(cell.volume, site);
  while (!small.empty()) {
    const auto [volume, site] = small.top();
    small.pop();
    const auto found = cut_.find(site);
    if (found == cut_.end() || found->second.volume != volume) continue;  // has grown meanwhile
    const auto next = best_neighbour(site, found->second);
    if (!next) continue;
    const CutCell part = std::move(found->second);
    cut_.erase(found);
    if (whole_[*next]) {
      Vec3 centre = centre_of_.count(site) != 0 ? centre_of_.at(site) : part.centroid;
      for (std::size_t axis = 0; axis < (lattice_.flat ? 2u : 3u); ++axis)
        for (const int side : {-1, 1})
          if (lattice_.neighbour(site, axis, side) == next)
            centre[static_cast<Eigen::Index>(axis)] += side * lattice_.spacing[static_cast<Eigen::Index>(axis)];
      cut_[*next] = box(centre);
      centre_of_[*next] = centre;
      whole_[*next] = false;
    }
    CutCell& target = cut_.at(*next);
    target.join(part);
    if (target.volume < limit) small.emplace(target.volume, *next);
  }
}

void CutSites::scale_to(double exact) {
  Vec3 size = lattice_.spacing;
  if (lattice_.flat) size[2] = 1.0;
  const double whole = static_cast<double>(std::count(whole_.begin(), whole_.end(), true)) * size.prod();
  std::vector<std::size_t> sites;  // summed in their order, which does not depend on the table
  for (const auto& entry : cut_) sites.push_back(entry.first);
  std::sort(sites.begin(), sites.end());
  double cut = 0.0;
  for (const std::size_t site : sites) cut += cut_.at(site).volume;
  const double factor = (exact - whole) / cut;
  if (!(std::abs(factor - 1) < 0.05)) return;
  for (auto& entry : cut_) entry.second.volume *= factor;
}

}  // namespace tribo
