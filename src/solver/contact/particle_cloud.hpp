// SPDX-License-Identifier: MIT
/// The particles around given nodes.
#pragma once

#include "solver/contact/mirror_planes.hpp"
#include "solver/state/particle_domain.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// Identifies a particle of the cloud: its field, its body (position in the list of bodies), its number there and that
/// of its image in the symmetry planes.
struct ParticleLabel {
  std::uint32_t field, body, particle, image;
};

/// The particles of one field in one cell, with the bounding box of their domains.
template <int Dim>
struct ParticleGroup {
  std::uint32_t field;       ///< number of the field
  std::uint32_t begin, end;  ///< particles begin to end - 1 of the cloud
  Vec<Dim> low, high;        ///< bounding box of the domains     [length]
  Vec<Dim> sum;              ///< of the centres                  [length]

  /// An upper bound of ParticleDomain::reach for all particles of the group [length].
  double reach_bound(const Vec<Dim>& origin, const Vec<Dim>& n) const {
    return (n.array() > 0).select(high - origin, low - origin).dot(n);
  }
};

/// Holds copies of the domains of all particles, and of their images in the symmetry planes, in the cells within reach
/// of the requested nodes. They are sorted by cell, and within a cell grouped by field.
template <int Dim>
class ParticleCloud {
 public:
  /// `reach`: particles at most this far from a node are within reach of it [length].
  ParticleCloud(const Lattice<Dim>& lattice, double reach, MirrorPlanes<Dim> planes = {});

  const MirrorPlanes<Dim>& planes() const { return planes_; }
  /// Removes all requests.
  void clear() { requested_.clear(); }
  /// Removes all particles, and gives their memory back.
  void release();
  /// Requests the particles within reach of a node.
  void request(const Index<Dim>& node) { requested_.push_back(node); }
  /// Copies the requested particles at their present positions. The bins of `bodies` must be those of the last sort.
  void collect(const std::vector<Body<Dim>*>& bodies);

  double reach() const { return reach_; }
  /// An upper bound of the distance from the centre of a domain to its points [length].
  double max_extent() const { return max_extent_; }
  /// Number of particles.
  std::size_t size() const { return labels_.size(); }
  /// Identity, centre and domain of particle k of the cloud.
  const ParticleLabel& label(std::size_t k) const { return labels_[k]; }
  Vec<Dim> centre(std::size_t k) const {
    Vec<Dim> x;
    for (std::size_t d = 0; d < Dim; ++d) x[static_cast<Eigen::Index>(d)] = column_[d][k];
    return x;
  }
  ParticleDomain<Dim> domain(std::size_t k) const {
    ParticleDomain<Dim> p;
    for (std::size_t c = 0; c < Dim; ++c) p.x.data()[c] = column_[c][k];
    for (std::size_t c = Dim; c < column_count; ++c) p.axes.data()[c - Dim] = column_[c][k];
    return p;
  }

  /// Columns of the coordinates of all centres, then of the components of the first, second ... half axes [length].
  std::array<const double*, Dim + Dim * Dim> columns() const {
    std::array<const double*, column_count> from;
    for (std::size_t c = 0; c < column_count; ++c) from[c] = column_[c].data();
    return from;
  }

  /// Calls f(group) for all groups that may contain particles within reach of a node.
  template <class F>
  void each_group(const Index<Dim>& node, F&& f) const {
    each_cell(node, [&](const Index<Dim>& block, int cell) {
      const int s = slot_[block];
      if (s < 0) return;
      const std::size_t at = static_cast<std::size_t>(s) * block_nodes<Dim> + static_cast<std::size_t>(cell);
      for (std::uint32_t g = start_[at]; g < start_[at + 1]; ++g) f(groups_[g]);
    });
  }
  /// Calls f(k) for the particles k of a group whose centres are within reach of a node at `centre`.
  template <class F>
  void each_point(const ParticleGroup<Dim>& group, const Vec<Dim>& centre, F&& f) const {
    for (std::uint32_t p = group.begin; p < group.end; ++p)
      if ((this->centre(p) - centre).squaredNorm() <= reach_ * reach_) f(p);
  }
  /// Writes ParticleDomain::reach, from a node at `centre` along the unit vector n, of each particle of a group to
  /// `out` [length]; -infinity for particles that are not within reach of the node.
  void compute_reach(const ParticleGroup<Dim>& group, const Vec<Dim>& centre, const Vec<Dim>& n,
                     double* __restrict out) const;

 private:
  // Calls f(block, cell in the block) for the cells that contain points within reach of a node.
  template <class F>
  void each_cell(const Index<Dim>& node, F&& f) const {
    for (const Index<Dim>& offset : offsets_) {
      Index<Dim> block;
      int local = 0;
      bool inside = true;
      for (std::size_t d = Dim; d-- > 0;) {
        constexpr unsigned edge = block_edge<Dim>;
        const auto cell = static_cast<unsigned>(node[d] + offset[d]);  // huge for cells below the lattice
        inside = inside && cell < static_cast<unsigned>(lattice_.blocks[d]) * edge;
        block[d] = static_cast<int>(cell / edge);
        local = local * static_cast<int>(edge) + static_cast<int>(cell % edge);
      }
      if (inside) f(block, local);
    }
  }

  void find_cells();
  bool is_requested(const Vec<Dim>& x, std::size_t& at) const;
  bool any_requested_near(std::int64_t bin_block) const;
  void group();

  Lattice<Dim> lattice_;
  MirrorPlanes<Dim> planes_;
  double reach_, max_extent_ = 0.0;
  Vec<Dim> per_length_;                                        ///< inverse cell sizes
  std::array<std::uint64_t, Dim == 2 ? 9 : 27> near_cells_{};  ///< see any_requested_near
  std::vector<Index<Dim>> offsets_;    ///< of the cells within reach, from the cell above the node
  std::vector<Index<Dim>> requested_;  ///< nodes
  BlockTable<Dim, int> slot_{-1};      ///< per block: position in mask_, or -1
  std::vector<std::uint64_t> mask_;    ///< per block with cells within reach of requested nodes: bits of these cells
  std::vector<std::uint32_t> start_;   ///< per cell of these blocks: first group
  std::vector<ParticleGroup<Dim>> groups_;
  static constexpr std::size_t column_count = Dim + Dim * Dim;
  std::array<std::vector<double>, column_count> column_;  ///< see columns()
  std::vector<ParticleLabel> labels_, unsorted_;
  std::vector<DomainReader<Dim>> domains_;      ///< scratch
  std::vector<std::uint32_t> cell_of_, first_;  ///< per unsorted particle: its cell; per cell: first particle
};

}  // namespace tribo
