// SPDX-License-Identifier: MIT
#include "solver/distribution/common_blocks.hpp"

#include "base/common_data.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace tribo {
namespace {

// The terms of a contact face belong to nodes at most this far from its node [nodes].
constexpr int reach_of_faces = 4;
// Particles beside a periodic edge reach nodes at most this far from it [nodes].
constexpr int beside_edge = 3;

template <int Dim>
class BlockSet {
 public:
  explicit BlockSet(const Lattice<Dim>& lattice) : lattice_(lattice) {}

  // Adds the blocks with nodes in a box, which may reach beyond the lattice.
  void add_nodes(const Index<Dim>& low, const Index<Dim>& high) {
    Index<Dim> first, last;
    for (std::size_t d = 0; d < Dim; ++d) {
      first[d] = std::max(low[d], 0) / block_edge<Dim>;
      last[d] = std::min(high[d] / block_edge<Dim>, lattice_.blocks[d] - 1);
    }
    each_in_box<Dim>(first, last, [&](const Index<Dim>& block) { blocks_.insert(lattice_.block_index(block)); });
  }
  // Adds the blocks within a distance of a point.
  void add_around(const Vec<Dim>& x, const Vec<Dim>& reach) {
    each_in_box<Dim>(lattice_.block_of(x - reach), lattice_.block_of(x + reach),
                     [&](const Index<Dim>& block) { blocks_.insert(lattice_.block_index(block)); });
  }

  // The blocks of all ranks.
  std::vector<std::int64_t> of_all_ranks() const {
    auto out = values_of_all_ranks(std::vector<std::int64_t>(blocks_.begin(), blocks_.end()));
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

 private:
  Lattice<Dim> lattice_;
  std::set<std::int64_t> blocks_;
};

// Calls f(block, bits of its nodes) for the blocks that the particles of a bin reach until the next sort.
template <int Dim, class F>
void each_reached_block(const Lattice<Dim>& lattice, const BinContent<Dim>& bin, int width, F&& f) {
  const Index<Dim> middle = lattice.block_at(bin.block);
  Index<Dim> low, high, first, last;
  for (std::size_t d = 0; d < Dim; ++d) {
    low[d] = middle[d] * block_edge<Dim> + bin.low[d] - 1, high[d] = middle[d] * block_edge<Dim> + bin.high[d] + width;
    first[d] = std::max(low[d], 0) / block_edge<Dim>;
    last[d] = std::min(high[d] / block_edge<Dim>, lattice.blocks[d] - 1);
  }
  each_in_box<Dim>(first, last, [&](const Index<Dim>& block) {
    Index<Dim> from = low, to = high;
    for (std::size_t d = 0; d < Dim; ++d) from[d] -= block[d] * block_edge<Dim>, to[d] -= block[d] * block_edge<Dim>;
    f(block, nodes_in_box<Dim>(from, to));
  });
}

// Blocks around the nodes that the particles of two bodies with different velocity fields may reach.
template <int Dim>
void add_faces(const Lattice<Dim>& lattice, int width, const std::vector<KnownBins<Dim>>& bodies, BlockSet<Dim>& to) {
  struct Reached {
    std::size_t field;
    std::uint64_t nodes;
  };
  std::unordered_map<std::int64_t, std::vector<Reached>> reached;
  for (const auto& known : bodies) {
    const std::size_t field = known.body->field;
    if (field == Body<Dim>::no_field) continue;
    for (const auto& bin : known.bins)
      each_reached_block(lattice, bin, width, [&](const Index<Dim>& block, std::uint64_t nodes) {
        auto& here = reached[lattice.block_index(block)];
        if (here.empty() || here.back().field != field) here.push_back({field, 0});
        here.back().nodes |= nodes;
      });
  }
  for (const auto& [number, fields] : reached) {
    std::uint64_t twice = 0;
    for (std::size_t k = 0; k < fields.size(); ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (fields[l].field != fields[k].field) twice |= fields[l].nodes & fields[k].nodes;
    if (twice == 0) continue;
    Index<Dim> low, high;
    low.fill(block_edge<Dim>), high.fill(-1);
    Index<Dim> first{}, last;
    last.fill(block_edge<Dim> - 1);
    int bit = 0;
    each_in_box<Dim>(first, last, [&](const Index<Dim>& n) {
      if ((twice >> bit++ & 1) == 0) return;
      for (std::size_t d = 0; d < Dim; ++d) low[d] = std::min(low[d], n[d]), high[d] = std::max(high[d], n[d]);
    });
    const Index<Dim> block = lattice.block_at(number);
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] += block[d] * block_edge<Dim> - reach_of_faces, high[d] += block[d] * block_edge<Dim> + reach_of_faces;
    }
    to.add_nodes(low, high);
  }
}

// Blocks around cracks, which the particles that they cut may reach, and the domains of integration around their tips.
template <int Dim>
void add_cracks(const Model& model, const System<Dim>& system, int width, BlockSet<Dim>& to) {
  const Vec<Dim> reach = (width + 4.0) * system.lattice.spacing;
  const double part = system.lattice.smallest_spacing() * block_edge<Dim>;  // [length]
  for (const auto& crack : system.cracks) {
    for (const auto& piece : crack.pieces) {
      // Points of the piece so close to each other that no block between them is left out
      const auto& a = crack.x[piece[0]];
      const auto& b = crack.x[piece[1]];
      const auto& c = crack.x[piece[Dim - 1]];
      const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
      const int n = std::max(1, static_cast<int>(std::ceil(longest / part)));
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= (Dim == 2 ? 0 : n - i); ++j)
          to.add_around(a + (i * (b - a) + (Dim == 2 ? 0 : j) * (c - a)) / n, reach);
    }
    if (!model.fracture) continue;
    for (const auto& tip : crack.tips)
      to.add_around(crack.x[tip.point], reach + Vec<Dim>::Constant((model.fracture->size + 2.0 + model.fracture->hop) *
                                                                   system.lattice.spacing.maxCoeff()));
  }
}

template <int Dim>
void add_joints(const System<Dim>& system, int width, BlockSet<Dim>& to) {
  const Vec<Dim> reach = (width + 2.0) * system.lattice.spacing;
  for (const auto& surface : system.joints)
    if (surface.crack == surface.none)
      for (const auto& x : surface.x) to.add_around(x, reach);
}

// Blocks at periodic edges whose nodes represent each other.
template <int Dim>
void add_periodic_edges(const Model& model, const Lattice<Dim>& lattice, int width,
                        const std::vector<KnownBins<Dim>>& bodies, BlockSet<Dim>& to) {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    if (!model.grid.periodic[axis]) continue;
    const int low = Lattice<Dim>::padding, high = low + model.grid.cells[axis];
    for (const auto& known : bodies)
      for (const auto& bin : known.bins)
        each_reached_block(lattice, bin, width, [&](const Index<Dim>& block, std::uint64_t) {
          const int first = block[axis] * block_edge<Dim>, last = first + block_edge<Dim> - 1;
          const auto holds_nodes_at = [&](int edge) {
            return last >= edge - beside_edge && first <= edge + beside_edge;
          };
          if (!holds_nodes_at(low) && !holds_nodes_at(high)) return;
          // all blocks at both edges
          for (const int edge : {low, high}) {
            Index<Dim> from = block, until = block;
            for (std::size_t d = 0; d < Dim; ++d)
              from[d] = block[d] * block_edge<Dim>, until[d] = from[d] + block_edge<Dim> - 1;
            from[axis] = edge - beside_edge, until[axis] = edge + beside_edge;
            to.add_nodes(from, until);
          }
        });
  }
}

bool is_periodic(const Model& model) {
  return std::any_of(model.grid.periodic.begin(), model.grid.periodic.end(), [](bool is) { return is; });
}

template <int Dim>
bool solves_faces(const Model& model, const System<Dim>& system) {
  // Where particles come and go, the nodes of the last step are shown once the particles are on all ranks.
  return (system.fields.size() > 1 && model.particles_change()) || system.contact_at_faces || system.blocks ||
         model.heat.contact_heating ||
         std::any_of(system.joints.begin(), system.joints.end(), [](const auto& surface) { return surface.interface; });
}

}  // namespace

template <int Dim>
bool has_common_blocks(const Model& model, const System<Dim>& system) {
  return solves_faces(model, system) || !system.cracks.empty() || !system.joints.empty() || is_periodic(model);
}

template <int Dim>
std::vector<std::int64_t> find_common_blocks(const Model& model, const System<Dim>& system, int width,
                                             const std::vector<KnownBins<Dim>>& bodies) {
  BlockSet<Dim> blocks(system.lattice);
  if (solves_faces(model, system)) add_faces(system.lattice, width, bodies, blocks);
  add_cracks(model, system, width, blocks);
  add_joints(system, width, blocks);
  add_periodic_edges(model, system.lattice, width, bodies, blocks);
  return blocks.of_all_ranks();
}

template bool has_common_blocks(const Model&, const System<2>&);
template bool has_common_blocks(const Model&, const System<3>&);
template std::vector<std::int64_t> find_common_blocks(const Model&, const System<2>&, int,
                                                      const std::vector<KnownBins<2>>&);
template std::vector<std::int64_t> find_common_blocks(const Model&, const System<3>&, int,
                                                      const std::vector<KnownBins<3>>&);

}  // namespace tribo
