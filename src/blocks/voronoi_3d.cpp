// SPDX-License-Identifier: MIT
#include "blocks/voronoi_3d.hpp"

#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tribo {
namespace {

// A face belongs to its first cell; of two copies of one cell to the one that the shift leads away from.
bool ours(std::int64_t self, std::int64_t other, const Vec3& shift) {
  if (other != self) return self < other;
  for (int d = 0; d < 3; ++d)
    if (shift[d] != 0) return shift[d] > 0;
  return false;
}

}  // namespace

Tessellation voronoi_3d(std::span<const Vec3> nuclei, const Vec3& low, const Vec3& high,
                        const std::array<bool, 3>& periodic) {
  const Vec3 size = high - low;
  const double edge = std::cbrt(size.prod() * 6 / static_cast<double>(nuclei.size()));
  std::array<int, 3> cells{};
  for (std::size_t d = 0; d < 3; ++d)
    cells[d] = std::clamp(static_cast<int>(size[static_cast<Eigen::Index>(d)] / edge), 1, 400);
  voro::container box(low[0], high[0], low[1], high[1], low[2], high[2], cells[0], cells[1], cells[2], periodic[0],
                      periodic[1], periodic[2], 8);
  for (std::size_t k = 0; k < nuclei.size(); ++k)
    box.put(static_cast<int>(k), nuclei[k][0], nuclei[k][1], nuclei[k][2]);
  Tessellation out;
  out.shapes.resize(nuclei.size());
  std::vector<std::vector<BlockFacet>> facets(nuclei.size());
  voro::c_loop_all loop(box);
  voro::voronoicell_neighbor cell;
  std::size_t found = 0;
  if (loop.start()) do {
      if (!box.compute_cell(cell, loop)) continue;
      ++found;
      const auto k = static_cast<std::size_t>(loop.pid());
      const Vec3& x = nuclei[k];
      std::vector<double> corners;
      std::vector<int> neighbours, faces;
      cell.vertices(x[0], x[1], x[2], corners);
      cell.neighbors(neighbours);
      cell.face_vertices(faces);
      BlockShape& shape = out.shapes[k];
      for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
        shape.corners.emplace_back(corners[c], corners[c + 1], corners[c + 2]);
      double largest = 0;
      std::size_t at = 0;
      for (const int neighbour : neighbours) {
        const auto count = static_cast<std::size_t>(faces[at]);
        std::vector<std::uint32_t> loop_of(count);
        for (std::size_t c = 0; c < count; ++c) loop_of[c] = static_cast<std::uint32_t>(faces[at + 1 + c]);
        at += count + 1;
        BlockFacet f;
        f.a = static_cast<std::int64_t>(k), f.b = neighbour < 0 ? BlockFacet::none : neighbour;
        for (const auto c : loop_of) f.corners.push_back(shape.corners[c]);
        f.geometry = face_geometry(f.corners, false, 1.0);
        if (f.geometry.normal.dot(f.geometry.centre - x) < 0) {
          std::reverse(loop_of.begin(), loop_of.end());
          std::reverse(f.corners.begin(), f.corners.end());
          f.geometry.normal *= -1;
        }
        shape.faces.push_back(std::move(loop_of));
        largest = std::max(largest, f.geometry.area);
        if (f.b != BlockFacet::none) {
          // the neighbour is the mirror image of the nucleus; from it follows which of its copies it is
          const Vec3 n = f.geometry.normal, there = x + 2 * n.dot(f.geometry.centre - x) * n;
          const Vec3 apart = there - nuclei[static_cast<std::size_t>(f.b)];
          for (int d = 0; d < 3; ++d)
            if (periodic[static_cast<std::size_t>(d)]) f.shift[d] = std::round(apart[d] / size[d]) * size[d];
          if (!ours(f.a, f.b, f.shift)) continue;
          f.geometry.normal = (nuclei[static_cast<std::size_t>(f.b)] + f.shift - x).normalized();
        }
        facets[k].push_back(std::move(f));
      }
      std::erase_if(facets[k], [&](const BlockFacet& f) { return f.geometry.area < 1e-6 * largest; });
    } while (loop.inc());
  if (found != nuclei.size()) throw std::runtime_error("a cell of the tessellation vanished: two nuclei coincide");
  for (auto& list : facets)
    for (auto& f : list) out.facets.push_back(std::move(f));
  return out;
}

}  // namespace tribo
