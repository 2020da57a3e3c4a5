// SPDX-License-Identifier: MIT
/// Nuclei of Voronoi cells: given as points, from a file, on a lattice, or at random.

#include "base/csv.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "input/builder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribo {

void Builder::nuclei(const Statement& s, BlockGroup& g) {
  static const std::vector<std::string> kinds{"file", "hexagons", "cubes", "octahedra", "random"};
  const auto ways = std::count_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return has(s, kind); });
  must(ways + (g.points.empty() ? 0 : 1) == 1, s.origin,
       "give the nuclei of <Voronoi> either as <pt>s or by one of " + join(kinds));
  for (const char* name : {"seed", "apart"})
    must(has(s, "random") || !has(s, name), s.origin, "'" + std::string(name) + "' belongs to 'random'");
  if (!(g.high - g.low).head(model_.dimension()).cwiseSign().isOnes()) return;
  const double volume = (g.high - g.low).head(model_.dimension()).prod();
  double count = has(s, "random") ? number(s, "random", Dimension::none) : 0.0;
  for (const char* kind : {"hexagons", "cubes", "octahedra"})
    if (const double spacing = number(s, kind, Dimension::length); spacing > 0)
      count = std::max(count, volume / std::pow(spacing, model_.dimension()));
  const double wanted = count * (model_.dimension() == 2 ? 5e3 : 2e4), free = available_memory();
  if (wanted > free && count <= 1e7) {
    problems_.add(s.origin,
                  format("about %.2g blocks need %.2g GB of memory; this machine has %.2g GB free. Use larger "
                         "or fewer blocks",
                         count, 1e-9 * wanted, 1e-9 * free));
    return;
  }
  if (has(s, "random")) random_nuclei(s, g);
  for (const auto& [kind, lattice] : {std::pair{"hexagons", PointLattice::hexagons},
                                      {"cubes", PointLattice::cubes},
                                      {"octahedra", PointLattice::octahedra}})
    if (has(s, kind)) lattice_nuclei(s, kind, lattice, g);
  const Attribute* file = s.attribute("file");
  if (file) nuclei_of_file(*file, g);
  if (file) must(!g.points.empty(), file->origin, "this table has no nuclei");
  if (file || ways == 0) check_nuclei(g);
}

void Builder::random_nuclei(const Statement& s, BlockGroup& g) {
  const double count = number(s, "random", Dimension::none), apart = number(s, "apart", Dimension::none, 0.6),
               seed = number(s, "seed", Dimension::none, 1);
  const bool sound = count >= 1 && count <= 1e7 && apart >= 0 && apart <= 0.8 && seed >= 0;
  must(sound, s.origin, "'random' must be a number of nuclei, 'apart' in [0, 0.8] and 'seed' not negative");
  if (!sound) return;
  try {
    g.points = random_points(static_cast<std::size_t>(count), g.low, g.high, model_.dimension() == 2, apart,
                             static_cast<std::uint64_t>(seed));
  } catch (const std::runtime_error& error) {
    problems_.add(s.origin, error.what());
  }
  g.point_origins.assign(g.points.size(), s.origin);
}

void Builder::lattice_nuclei(const Statement& s, const std::string& kind, PointLattice lattice, BlockGroup& g) {
  const double spacing = number(s, kind, Dimension::length);
  const bool plane = model_.dimension() == 2,
             fits = lattice == PointLattice::cubes || plane == (lattice == PointLattice::hexagons);
  must(fits, s.origin, "'" + kind + "' belongs to " + (plane ? "three dimensions" : "plane models"));
  must(spacing > 0, s.origin, "'" + kind + "' must be a positive distance");
  if (!fits || !(spacing > 0)) return;
  double many = 1;
  for (Eigen::Index d = 0; d < model_.dimension(); ++d) many *= (g.high[d] - g.low[d]) / spacing;
  must(many < 1e7, s.origin, "'" + kind + "' gives " + std::to_string(many) + " blocks; at most 1e7 are allowed");
  if (many < 1e7) g.points = lattice_points(lattice, spacing, g.low, g.high, plane);
  g.point_origins.assign(g.points.size(), s.origin);
}

void Builder::nuclei_of_file(const Attribute& file, BlockGroup& g) {
  const auto dimension = static_cast<std::size_t>(model_.dimension());
  const auto place = data_file(file.text);
  const auto text = content_of(place, file.origin);
  if (!text) return;
  const Origin begin{std::make_shared<const std::string>(place.string()), 1, 1};
  bool first = true;
  for (const auto& row : read_csv(*text, begin)) {
    if (problems_.full()) return;
    std::array<double, 3> x{};
    bool good = row.cells.size() == dimension;
    for (std::size_t d = 0; good && d < dimension; ++d) {
      const auto value = to_number(row.cells[d].text);
      good = value.has_value(), x[d] = value.value_or(0) * model_.units.factor(Dimension::length);
    }
    if (!good && !first)
      problems_.add(row.origin, "a nucleus needs " + std::to_string(dimension) + " numbers, separated by commas");
    if (good) g.points.emplace_back(x[0], x[1], x[2]), g.point_origins.push_back(row.origin);
    first = false;  // may be a header line
  }
}

void Builder::check_nuclei(const BlockGroup& g) {
  std::vector<std::size_t> order(g.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Along a direction in which few points are level
  const auto along = [&](std::size_t k) { return g.points[k].dot(Vec3(0.7, 0.55902, 0.44444)); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  const double same = 1e-9 * (g.high - g.low).norm();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3& x = g.points[order[i]];
    for (Eigen::Index d = 0; d < model_.dimension(); ++d)
      if (!(x[d] > g.low[d] && x[d] < g.high[d])) {
        problems_.add(g.point_origins[order[i]], "this nucleus does not lie within the box of <Voronoi>");
        break;
      }
    for (std::size_t j = i + 1; j < order.size() && along(order[j]) - along(order[i]) <= 2 * same; ++j)
      must((g.points[order[j]] - x).norm() > same, g.point_origins[std::max(order[i], order[j])],
           "this nucleus coincides with the one at " + g.point_origins[std::min(order[i], order[j])].text());
  }
}

}  // namespace tribo
