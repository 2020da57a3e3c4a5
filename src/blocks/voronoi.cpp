// SPDX-License-Identifier: MIT
/// Voronoi cells in the plane: a box cut by the half-planes that are nearer to one nucleus than to another.

#include "blocks/shape.hpp"
#include "blocks/voronoi_3d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace tribo {
namespace {

/// A nucleus or its copy in a neighbouring period.
struct Site {
  Vec3 x;
  std::int64_t cell;
  Vec3 shift;
};

/// A polygon, each of whose edges knows the site beyond it.
struct Cell {
  struct Edge {
    Vec3 from;
    std::int64_t beyond;  // index of a site, or -1
  };
  std::vector<Edge> edges;

  /// Keeps what is nearer to `x` than to `y`.
  void cut(const Vec3& x, const Vec3& y, std::int64_t site, std::vector<Edge>& spare) {
    const Vec3 n = y - x, middle = 0.5 * (x + y);
    const auto side = [&](const Vec3& p) { return n.dot(p - middle); };
    spare.clear();
    bool cuts = false;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Edge& e = edges[k];
      const Vec3& to = edges[(k + 1) % edges.size()].from;
      const double a = side(e.from), b = side(to);
      if (a <= 0) spare.push_back(e);
      if ((a <= 0) != (b <= 0)) {
        const Vec3 p = e.from + a / (a - b) * (to - e.from);
        cuts = true;
        // leaving the half-plane the new edge begins; entering it the old edge goes on
        spare.push_back({p, a <= 0 ? site : e.beyond});
      }
    }
    if (cuts) edges.swap(spare);
  }
  double reach(const Vec3& x) const {
    double out = 0;
    for (const Edge& e : edges) out = std::max(out, (e.from - x).norm());
    return out;
  }
};

/// Sites by squares of a lattice, about two in each.
class Lookup {
 public:
  explicit Lookup(const std::vector<Site>& sites) {
    low_ = high_ = sites.front().x;
    for (const Site& s : sites) low_ = low_.cwiseMin(s.x), high_ = high_.cwiseMax(s.x);
    const Vec3 size = high_ - low_;
    edge_ = std::max(std::sqrt(size[0] * size[1] * 2 / static_cast<double>(sites.size())),
                     1e-3 * std::max(size[0], size[1]));
    if (!(edge_ > 0)) edge_ = 1;
    for (std::size_t k = 0; k < sites.size(); ++k) squares_[square(sites[k].x)].push_back(k);
    rings_ = static_cast<int>(std::max(size[0], size[1]) / edge_) + 2;
  }
  /// Calls f(site) for those in the ring of squares at this distance from x.
  template <class F>
  void ring(const Vec3& x, int r, F&& f) const {
    const auto [i, j] = square(x);
    for (int a = -r; a <= r; ++a)
      for (int b = -r; b <= r; b += std::abs(a) == r ? 1 : std::max(1, 2 * r)) {
        const auto found = squares_.find({i + a, j + b});
        if (found != squares_.end())
          for (const std::size_t k : found->second) f(k);
      }
  }
  double edge() const { return edge_; }
  int rings() const { return rings_; }

 private:
  std::pair<int, int> square(const Vec3& x) const {
    return {static_cast<int>(std::floor((x[0] - low_[0]) / edge_)),
            static_cast<int>(std::floor((x[1] - low_[1]) / edge_))};
  }
  Vec3 low_, high_;
  double edge_ = 1;
  int rings_ = 1;
  std::map<std::pair<int, int>, std::vector<std::size_t>> squares_;
};

void check(std::span<const Vec3> nuclei, const Vec3& low, const Vec3& high, bool plane) {
  if (nuclei.empty()) throw std::runtime_error("a tessellation needs nuclei");
  for (std::size_t k = 0; k < nuclei.size(); ++k)
    for (int d = 0; d < (plane ? 2 : 3); ++d)
      if (!(nuclei[k][d] > low[d] && nuclei[k][d] < high[d]))
        throw std::runtime_error("nucleus " + std::to_string(k + 1) + " does not lie within the box");
  std::vector<Vec3> sorted(nuclei.begin(), nuclei.end());
  std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) { return a[0] < b[0]; });
  const double same = 1e-9 * (high - low).norm();
  for (std::size_t k = 0; k < sorted.size(); ++k)
    for (std::size_t j = k + 1; j < sorted.size() && sorted[j][0] - sorted[k][0] <= same; ++j)
      if ((sorted[j] - sorted[k]).norm() <= same)
        throw std::runtime_error("two nuclei coincide at (" + std::to_string(sorted[k][0]) + ", " +
                                 std::to_string(sorted[k][1]) + ")");
}

}  // namespace

Tessellation voronoi(std::span<const Vec3> nuclei, const Vec3& low, const Vec3& high, bool plane, double thickness,
                     const std::array<bool, 3>& periodic) {
  check(nuclei, low, high, plane);
  if (!plane) return voronoi_3d(nuclei, low, high, periodic);
  const Vec3 size = high - low;
  std::vector<Site> sites;
  for (int i = periodic[0] ? -1 : 0; i <= (periodic[0] ? 1 : 0); ++i)
    for (int j = periodic[1] ? -1 : 0; j <= (periodic[1] ? 1 : 0); ++j)
      for (std::size_t k = 0; k < nuclei.size(); ++k) {
        const Vec3 shift(i * size[0], j * size[1], 0);
        sites.push_back({nuclei[k] + shift, static_cast<std::int64_t>(k), shift});
      }
  const Lookup lookup(sites);
  Tessellation out;
  std::vector<Cell::Edge> spare;
  for (std::size_t k = 0; k < nuclei.size(); ++k) {
    const Vec3& x = nuclei[k];
    Vec3 a = low, b = high;  // of a periodic axis the cell may reach beyond
    for (int d = 0; d < 2; ++d)
      if (periodic[static_cast<std::size_t>(d)]) a[d] = x[d] - size[d], b[d] = x[d] + size[d];
    Cell cell{{{{a[0], a[1], 0}, -1}, {{b[0], a[1], 0}, -1}, {{b[0], b[1], 0}, -1}, {{a[0], b[1], 0}, -1}}};
    for (int r = 0; r <= lookup.rings(); ++r) {
      if ((r - 1) * lookup.edge() > 2 * cell.reach(x)) break;
      lookup.ring(x, r, [&](std::size_t s) {
        if (sites[s].x != x) cell.cut(x, sites[s].x, static_cast<std::int64_t>(s), spare);
      });
    }
    double longest = 0;
    const std::size_t n = cell.edges.size();
    const auto length = [&](std::size_t e) { return (cell.edges[(e + 1) % n].from - cell.edges[e].from).norm(); };
    for (std::size_t e = 0; e < n; ++e) longest = std::max(longest, length(e));
    BlockShape shape;
    for (std::size_t e = 0; e < n; ++e) {
      if (length(e) <= 1e-9 * longest) continue;
      shape.corners.push_back(cell.edges[e].from);
      const std::int64_t beyond = cell.edges[e].beyond;
      const Site* other = beyond < 0 ? nullptr : &sites[static_cast<std::size_t>(beyond)];
      // every face once: of its first cell; of a cell that meets its own copy: to the right or above
      const auto self = static_cast<std::int64_t>(k);
      if (other && (other->cell < self ||
                    (other->cell == self && (other->shift[0] < 0 || (other->shift[0] == 0 && other->shift[1] < 0)))))
        continue;
      if (length(e) <= 1e-6 * longest) continue;
      BlockFacet f;
      f.a = self, f.b = other ? other->cell : BlockFacet::none;
      f.corners = {cell.edges[e].from, cell.edges[(e + 1) % n].from};
      f.geometry = face_geometry(f.corners, true, thickness);
      if (other) f.geometry.normal = (other->x - x).normalized(), f.shift = other->shift;
      out.facets.push_back(std::move(f));
    }
    for (std::uint32_t c = 0; c < shape.corners.size(); ++c)
      shape.faces.push_back({c, static_cast<std::uint32_t>((c + 1) % shape.corners.size())});
    out.shapes.push_back(std::move(shape));
  }
  return out;
}

}  // namespace tribo
