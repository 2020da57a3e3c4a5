// SPDX-License-Identifier: MIT
/// The particles around the nodes where bodies meet.
#pragma once

#include "solver/state/particle_domain.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// Whose particle a point is.
struct ParticleLabel {
  std::uint32_t field, body, particle;
};

/// The particles of a field in a cell, and the box around their domains.
template <int Dim>
struct ParticleGroup {
  std::uint32_t field, begin, end;  ///< points begin to end - 1
  Vec<Dim> low, high, sum;          ///< box; sum of the centres

  /// No domain of the group reaches farther from `origin` along n.
  double bound(const Vec<Dim>& origin, const Vec<Dim>& n) const {
    return (n.array() > 0).select(high - origin, low - origin).dot(n);
  }
};

/// Particles in the cells within reach of given nodes, sorted by cell and grouped by field.
template <int Dim>
class ParticleCloud {
 public:
  /// `reach`: radius of the balls about nodes [length].
  ParticleCloud(const Lattice<Dim>& lattice, double reach);

  /// Forgets all nodes.
  void begin();
  /// Wants the particles within reach of a node.
  void want(const Index<Dim>& node);
  /// Collects them. Bodies are numbered as they come: deformable, then rigid ones with a field of their own.
  void collect(const std::vector<Body<Dim>*>& bodies);

  double reach() const { return reach_; }
  /// No domain reaches farther from its centre [length].
  double largest() const { return largest_; }
  std::size_t size() const { return labels_.size(); }
  const ParticleLabel& label(std::size_t k) const { return labels_[k]; }
  Vec<Dim> centre(std::size_t k) const {
    Vec<Dim> x;
    for (std::size_t d = 0; d < Dim; ++d) x[static_cast<Eigen::Index>(d)] = column_[d][k];
    return x;
  }
  ParticleDomain<Dim> point(std::size_t k) const {
    ParticleDomain<Dim> p;
    for (std::size_t c = 0; c < Dim; ++c) p.x.data()[c] = column_[c][k];
    for (std::size_t c = Dim; c < columns; ++c) p.axes.data()[c - Dim] = column_[c][k];
    return p;
  }

  /// Coordinates of the points' centres, then their half axes one after the other.
  std::array<const double*, Dim + Dim * Dim> data() const {
    std::array<const double*, columns> from;
    for (std::size_t c = 0; c < columns; ++c) from[c] = column_[c].data();
    return from;
  }

  /// Calls f(group) for the groups that may have particles within reach of a node.
  template <class F>
  void each_group(const Index<Dim>& node, F&& f) const {
    each_cell(node, [&](std::int64_t block, int cell) {
      const int s = slot_[static_cast<std::size_t>(block)];
      if (s < 0) return;
      const std::size_t at = static_cast<std::size_t>(s) * block_nodes<Dim> + static_cast<std::size_t>(cell);
      for (std::uint32_t g = start_[at]; g < start_[at + 1]; ++g) f(groups_[g]);
    });
  }
  /// Calls f(number of the point) for the particles of a group within reach of a node at `centre`.
  template <class F>
  void each_point(const ParticleGroup<Dim>& group, const Vec<Dim>& centre, F&& f) const {
    for (std::uint32_t p = group.begin; p < group.end; ++p)
      if ((this->centre(p) - centre).squaredNorm() <= reach_ * reach_) f(p);
  }
  /// How far the domains of a group's particles reach from a node at `centre` along n, one value each; -infinity for
  /// those beyond the reach of the cloud.
  void measure(const ParticleGroup<Dim>& group, const Vec<Dim>& centre, const Vec<Dim>& n,
               double* __restrict out) const;

 private:
  // Calls f(block, cell in the block) for the cells that a ball about a node cuts.
  template <class F>
  void each_cell(const Index<Dim>& node, F&& f) const {
    for (const Index<Dim>& offset : offsets_) {
      Index<Dim> block;
      int local = 0;
      bool inside = true;
      for (std::size_t d = Dim; d-- > 0;) {
        constexpr unsigned edge = block_edge<Dim>;
        const auto cell = static_cast<unsigned>(node[d] + offset[d]);  // below the lattice it is huge
        inside = inside && cell < static_cast<unsigned>(lattice_.blocks[d]) * edge;
        block[d] = static_cast<int>(cell / edge);
        local = local * static_cast<int>(edge) + static_cast<int>(cell % edge);
      }
      if (inside) f(lattice_.block_index(block), local);
    }
  }

  bool wanted(const Vec<Dim>& x, std::size_t& at) const;
  bool any_wanted_near(std::int64_t bin_block) const;
  void group();

  Lattice<Dim> lattice_;
  double reach_, largest_ = 0.0;
  Vec<Dim> per_length_;                                        ///< cells per length
  std::array<std::uint64_t, Dim == 2 ? 9 : 27> near_cells_{};  ///< of a block and its neighbours: see any_wanted_near
  std::vector<Index<Dim>> offsets_;   ///< cells that a ball about a node cuts, from the cell above the node
  std::vector<int> slot_;             ///< per lattice block: position among the blocks with wanted cells, or -1
  std::vector<std::int64_t> blocks_;  ///< those blocks
  std::vector<std::uint64_t> mask_;   ///< their wanted cells
  std::vector<std::uint32_t> start_;  ///< per cell of those blocks: first group
  std::vector<ParticleGroup<Dim>> groups_;
  static constexpr std::size_t columns = Dim + Dim * Dim;
  std::array<std::vector<double>, columns> column_;  ///< centres and half axes of the points
  std::vector<ParticleLabel> labels_, unsorted_;
  std::vector<DomainReader<Dim>> domains_;      ///< scratch
  std::vector<std::uint32_t> cell_of_, first_;  ///< per unsorted point: its cell; per cell: first point
};

}  // namespace tribo
