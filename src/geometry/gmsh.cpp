// SPDX-License-Identifier: MIT
/// Gmsh's own library would bring Open CASCADE, MED and a hundred other libraries for a format of a few sections of
/// text, and VTK of Debian has no reader; so it is read here.
#include "geometry/gmsh.hpp"

#include "geometry/file_words.hpp"

#include <map>
#include <unordered_map>

namespace tribo {
namespace {

constexpr std::int64_t most_entries = 500'000'000;  // fewer than 32-bit numbers of points

/// A shape of elements: its dimension and corners; corners 0: a shape of higher order.
struct ElementShape {
  int dimension;
  std::size_t corners;
};

// By the numbers of the format. Others are of higher order.
std::optional<ElementShape> shape_of(std::int64_t type) {
  switch (type) {
    case 1:
      return ElementShape{1, 2};
    case 2:
      return ElementShape{2, 3};
    case 3:
      return ElementShape{2, 4};
    case 4:
      return ElementShape{3, 4};
    case 5:
      return ElementShape{3, 8};
    case 6:
      return ElementShape{3, 6};
    case 7:
      return ElementShape{3, 5};
    case 15:
      return ElementShape{0, 1};
    default:
      return std::nullopt;
  }
}

class GmshReader {
 public:
  explicit GmshReader(const std::string& path) : bytes_(path), words_(bytes_) {}

  GmshMesh read() {
    if (words_.next() != "$MeshFormat") words_.fail("this is not a mesh of Gmsh: it does not begin with $MeshFormat");
    const double version = words_.number();
    if (words_.number() != 0)
      words_.fail("this mesh is binary; write it as text: 'gmsh MODEL -2 -format msh41' (without -bin)");
    new_ = version >= 4;
    if (version != 4.1 && !(version >= 2 && version < 3))
      words_.fail("the formats 4.1 and 2.2 are read, not " + std::to_string(version).substr(0, 3) +
                  "; write it with 'gmsh MODEL -save -format msh41'");
    skip_to("$EndMeshFormat");
    for (auto section = words_.next(); !section.empty(); section = words_.next()) {
      if (section == "$PhysicalNames")
        physical_names();
      else if (section == "$Entities" && new_)
        entities();
      else if (section == "$Nodes")
        new_ ? nodes() : nodes_in_a_row();
      else if (section == "$Elements")
        new_ ? elements() : elements_in_a_row();
      else if (section.front() != '$')
        words_.fail("a section such as $Nodes is expected, not " + FileWords::shown(section));
      skip_to("$End" + std::string(section.substr(1)));
    }
    if (mesh_.blocks.empty()) bytes_.fail("the mesh has no elements; this is not a complete file of Gmsh");
    return std::move(mesh_);
  }

 private:
  std::int64_t count() { return words_.whole(0, most_entries); }
  std::int64_t tag() { return words_.whole(-most_entries, most_entries); }

  void skip_to(const std::string& end) {
    const std::string_view begun = end;
    for (auto word = words_.next(); word != begun; word = words_.next())
      if (word.empty()) words_.fail("the file ends before " + end);
  }

  // dimension number "name"
  void physical_names() {
    for (auto n = count(); n > 0; --n) {
      GmshMesh::Group group;
      group.dimension = static_cast<int>(words_.whole(0, 3));
      group.number = static_cast<int>(tag());
      const auto rest = words_.rest_of_line();
      const auto first = rest.find('"'), last = rest.rfind('"');
      if (first == last) words_.fail("the name of a group in quotes is expected");
      group.name = rest.substr(first + 1, last - first - 1);
      mesh_.groups.push_back(std::move(group));
    }
  }

  // Points have a position, all others a box; then the numbers of their groups and, except of points, of their edge.
  void entities() {
    std::array<std::int64_t, 4> counts{};
    for (auto& n : counts) n = count();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (auto n = counts[static_cast<std::size_t>(dimension)]; n > 0; --n) {
        const auto entity = tag();
        for (int k = dimension == 0 ? 3 : 6; k > 0; --k) words_.number();
        auto& groups = groups_of_[{dimension, entity}];
        for (auto k = count(); k > 0; --k) groups.push_back(static_cast<int>(std::abs(tag())));
        if (dimension > 0)
          for (auto k = count(); k > 0; --k) tag();
      }
  }

  void point(std::int64_t number) {
    Vec3 x;
    for (double& value : x) {
      value = words_.number();
      if (!std::isfinite(value)) words_.fail("a coordinate is not a finite number");
    }
    if (!place_.emplace(number, static_cast<std::uint32_t>(mesh_.points.size())).second)
      words_.fail("the node " + std::to_string(number) + " occurs twice");
    mesh_.points.push_back(x);
  }

  // Blocks of nodes: first their numbers, then their positions.
  void nodes() {
    const auto blocks = count();
    count(), tag(), tag();
    for (auto b = blocks; b > 0; --b) {
      const auto dimension = words_.whole(0, 3);
      tag();
      const bool parametric = words_.whole(0, 1) == 1;
      std::vector<std::int64_t> numbers;
      for (auto n = count(); n > 0; --n) numbers.push_back(tag());
      for (const auto number : numbers) {
        point(number);
        for (auto k = parametric ? dimension : 0; k > 0; --k) words_.number();
      }
    }
  }
  void nodes_in_a_row() {
    for (auto n = count(); n > 0; --n) point(tag());
  }

  ElementShape shape() {
    const auto type = words_.whole(1, 1000);
    const auto shape = shape_of(type);
    if (!shape)
      words_.fail("the elements of type " + std::to_string(type) +
                  " are of higher order; lines, triangles, quadrangles, tetrahedra, hexahedra, prisms and pyramids of "
                  "first order are read: write the mesh with 'gmsh -order 1'");
    return *shape;
  }
  void corners(GmshMesh::Block& block) {
    for (std::size_t k = 0; k < block.corners; ++k) {
      const auto number = tag();
      const auto found = place_.find(number);
      if (found == place_.end()) words_.fail("the node " + std::to_string(number) + " does not exist");
      block.nodes.push_back(found->second);
    }
  }

  void elements() {
    const auto blocks = count();
    count(), tag(), tag();
    for (auto b = blocks; b > 0; --b) {
      const auto dimension = static_cast<int>(words_.whole(0, 3));
      const auto entity = tag();
      const ElementShape of = shape();
      GmshMesh::Block block{of.dimension, of.corners, groups_of_[{dimension, entity}], {}};
      for (auto n = count(); n > 0; --n) tag(), corners(block);
      mesh_.blocks.push_back(std::move(block));
    }
  }
  // Each with its type and tags, of which the first is its group.
  void elements_in_a_row() {
    for (auto n = count(); n > 0; --n) {
      tag();
      const ElementShape of = shape();
      const auto tags = count();
      std::vector<int> groups;
      for (std::int64_t k = 0; k < tags; ++k)
        if (const auto value = tag(); k == 0 && value != 0) groups.push_back(static_cast<int>(value));
      if (mesh_.blocks.empty() || mesh_.blocks.back().dimension != of.dimension ||
          mesh_.blocks.back().corners != of.corners || mesh_.blocks.back().groups != groups)
        mesh_.blocks.push_back({of.dimension, of.corners, groups, {}});
      corners(mesh_.blocks.back());
    }
  }

  Bytes bytes_;
  FileWords words_;
  GmshMesh mesh_;
  bool new_ = true;
  std::map<std::pair<int, std::int64_t>, std::vector<int>> groups_of_;  ///< of an entity: dimension, number
  std::unordered_map<std::int64_t, std::uint32_t> place_;               ///< of the nodes among the points
};

}  // namespace

GmshMesh read_gmsh(const std::string& path) { return GmshReader(path).read(); }

}  // namespace tribo
