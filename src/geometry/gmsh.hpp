// SPDX-License-Identifier: MIT
/// Meshes of Gmsh, the formats 4.1 and 2.2 as text.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// Points, elements of first order between them, and the physical groups of these.
struct GmshMesh {
  /// A set of elements with a name or a number.
  struct Group {
    int dimension = 0;
    int number = 0;
    std::string name;  ///< empty if the file has none
  };
  /// Elements of one shape that belong to the same groups.
  struct Block {
    int dimension = 0;
    std::size_t corners = 0;           ///< of an element
    std::vector<int> groups;           ///< numbers of the groups of this dimension
    std::vector<std::uint32_t> nodes;  ///< corners of the elements, one after the other
  };
  std::vector<Vec3> points;  ///< in the unit of the file
  std::vector<Group> groups;
  std::vector<Block> blocks;
};

/// Reads a mesh. Throws FileError `path:line:column: message` for what is not possible, with the remedy for binary
/// files and for elements of higher order.
GmshMesh read_gmsh(const std::string& path);

/// The triangles of the surface of a group: of volumes their outer faces, of surfaces themselves. `group`: a name or a
/// number; empty: all volumes or, if there are none, all surfaces. Throws FileError if there is no such group.
std::vector<std::array<Vec3, 3>> gmsh_surface(const std::string& path, const std::string& group);

/// The outline of a part of a mesh in the plane.
struct GmshOutline {
  std::vector<std::array<Vec<2>, 2>> edges;
  std::optional<double> area;  ///< of the elements; unknown for a group of lines
};
/// The edges around a group: of surfaces their outer edges, of lines themselves. `group`: as for gmsh_surface, one
/// dimension lower. Throws FileError if there is no such group, or if the part is not in a plane of constant z.
GmshOutline gmsh_outline(const std::string& path, const std::string& group);

}  // namespace tribo
