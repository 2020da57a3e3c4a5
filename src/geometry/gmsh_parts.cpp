// SPDX-License-Identifier: MIT
/// Surfaces and outlines of the parts of a mesh.
#include "base/error.hpp"
#include "base/schema.hpp"
#include "geometry/gmsh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <set>

namespace tribo {
namespace {

using Corners = std::vector<std::uint32_t>;
using LocalFaces = std::vector<std::vector<std::size_t>>;

/// What belongs to a body: blocks of elements of one dimension.
struct MeshPart {
  int dimension = 0;
  std::vector<const GmshMesh::Block*> blocks;
};

const char* name_of_dimension(int dimension) {
  return dimension == 0 ? "points" : dimension == 1 ? "lines" : dimension == 2 ? "surfaces" : "volumes";
}

std::string shown_group(const GmshMesh::Group& group) {
  return (group.name.empty() ? std::to_string(group.number) : "'" + group.name + "'") + " (" +
         name_of_dimension(group.dimension) + ")";
}

// The groups of the file, also those without a name.
std::vector<GmshMesh::Group> all_groups(const GmshMesh& mesh) {
  auto out = mesh.groups;
  for (const auto& block : mesh.blocks)
    for (const int number : block.groups)
      if (std::none_of(out.begin(), out.end(),
                       [&](const auto& g) { return g.dimension == block.dimension && g.number == number; }))
        out.push_back({block.dimension, number, {}});
  return out;
}

[[noreturn]] void no_such_group(const std::string& path, const std::string& group,
                                const std::vector<GmshMesh::Group>& groups, int dimension) {
  std::vector<std::string> names, valid;
  for (const auto& g : groups) {
    const bool suits = g.dimension == dimension || g.dimension == dimension - 1;
    if (suits) valid.push_back(shown_group(g));
    if (suits && !g.name.empty()) names.push_back(g.name);
    if (g.name == group && !suits)
      throw FileError(path + ": the physical group '" + group + "' consists of " + name_of_dimension(g.dimension) +
                      "; " + name_of_dimension(dimension) + " or " + name_of_dimension(dimension - 1) +
                      " are needed here");
  }
  throw FileError(path + ": the mesh has no physical group '" + group + "'" + did_you_mean(group, names) +
                  (valid.empty() ? std::string("; it has none of surfaces or volumes") : "; valid: " + join(valid)));
}

// The elements of a group of the dimension of the model, or one lower.
MeshPart part_of(const GmshMesh& mesh, const std::string& path, const std::string& group, int dimension) {
  const auto groups = all_groups(mesh);
  for (const int d : {dimension, dimension - 1}) {
    MeshPart part{d, {}};
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
      return g.dimension == d && (g.name == group || std::to_string(g.number) == group);
    });
    if (!group.empty() && found == groups.end()) continue;
    for (const auto& block : mesh.blocks)
      if (block.dimension == d &&
          (group.empty() || std::find(block.groups.begin(), block.groups.end(), found->number) != block.groups.end()))
        part.blocks.push_back(&block);
    if (!part.blocks.empty()) return part;
    if (!group.empty()) throw FileError(path + ": the physical group '" + group + "' has no elements");
  }
  if (!group.empty()) no_such_group(path, group, groups, dimension);
  throw FileError(path + ": the mesh has neither " + name_of_dimension(dimension) + " nor " +
                  name_of_dimension(dimension - 1) + "; make it with 'gmsh MODEL -" + std::to_string(dimension) + "'");
}

// The faces of an element, seen from outside counterclockwise, as places in its list of corners.
const LocalFaces& faces_of(std::size_t corners) {
  static const LocalFaces tetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
      pyramid{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
      prism{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
      hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return corners == 4 ? tetrahedron : corners == 5 ? pyramid : corners == 6 ? prism : hexahedron;
}

// The sides of all elements that belong to one element only, in the order of the file.
class OuterSides {
 public:
  void add(const Corners& side) {
    Corners key = side;
    std::sort(key.begin(), key.end());
    if (const auto [found, is_new] = place_.emplace(std::move(key), sides_.size()); !is_new)
      sides_[found->second].clear();
    else
      sides_.push_back(side);
  }
  template <class F>
  void for_each(F&& visit) const {
    for (const Corners& side : sides_)
      if (!side.empty()) visit(side);
  }

 private:
  std::map<Corners, std::size_t> place_;
  std::vector<Corners> sides_;
};

// Each element once: the format 2.2 lists an element for each of its groups.
template <class F>
void for_each_element(const MeshPart& part, F&& visit) {
  std::set<Corners> known;
  for (const auto* block : part.blocks)
    for (std::size_t at = 0; at < block->nodes.size(); at += block->corners) {
      const Corners element(block->nodes.begin() + static_cast<std::ptrdiff_t>(at),
                            block->nodes.begin() + static_cast<std::ptrdiff_t>(at + block->corners));
      if (known.insert(element).second) visit(element);
    }
}

}  // namespace

std::vector<std::array<Vec3, 3>> gmsh_surface(const std::string& path, const std::string& group) {
  const GmshMesh mesh = read_gmsh(path);
  const MeshPart part = part_of(mesh, path, group, 3);
  std::vector<std::array<Vec3, 3>> out;
  const auto add = [&](const Corners& face) {
    for (std::size_t k = 2; k < face.size(); ++k)
      out.push_back({mesh.points[face[0]], mesh.points[face[k - 1]], mesh.points[face[k]]});
  };
  if (part.dimension == 2) {
    for_each_element(part, add);
    return out;
  }
  OuterSides outer;
  for_each_element(part, [&](const Corners& element) {
    for (const auto& local : faces_of(element.size())) {
      Corners face;
      for (const std::size_t k : local) face.push_back(element[k]);
      outer.add(face);
    }
  });
  outer.for_each(add);
  return out;
}

GmshOutline gmsh_outline(const std::string& path, const std::string& group) {
  const GmshMesh mesh = read_gmsh(path);
  const MeshPart part = part_of(mesh, path, group, 2);
  GmshOutline out;
  std::optional<double> z;
  double extent = 0.0, off = 0.0;
  const auto flat = [&](std::uint32_t node) -> Vec<2> {
    const Vec3& x = mesh.points[node];
    if (!z) z = x[2];
    off = std::max(off, std::abs(x[2] - *z)), extent = std::max(extent, x.cwiseAbs().maxCoeff());
    return x.head<2>();
  };
  const auto add = [&](const Corners& edge) { out.edges.push_back({flat(edge[0]), flat(edge[1])}); };
  if (part.dimension == 1) {
    for_each_element(part, add);
  } else {
    OuterSides outer;
    double area = 0.0;
    for_each_element(part, [&](const Corners& element) {
      for (std::size_t k = 0; k < element.size(); ++k) outer.add({element[k], element[(k + 1) % element.size()]});
      double twice = 0.0;
      for (std::size_t k = 2; k < element.size(); ++k) {
        const Vec<2> a = flat(element[k - 1]) - flat(element[0]), b = flat(element[k]) - flat(element[0]);
        twice += a[0] * b[1] - a[1] * b[0];
      }
      area += 0.5 * std::abs(twice);
    });
    outer.for_each(add);
    out.area = area;
  }
  if (off > 1e-9 * extent)
    throw FileError(path +
                    ": the mesh is not in a plane of constant z, as a two-dimensional model needs it; its "
                    "points differ by " +
                    std::to_string(off) + " in z");
  return out;
}

}  // namespace tribo
