/// The particles around the nodes where bodies meet.
#pragma once

#include "solver/system.hpp"

#include <cstdint>
#include <vector>

namespace tribo {

/// A particle as a parallelepiped: centre and half axes, deformed with F.
template <int Dim>
struct CloudPoint {
  Vec<Dim> x;
  Mat<Dim> axes;  ///< columns: half axes of the domain
  std::uint32_t field, body, particle;
};

/// Particles in the cells within reach of given nodes, sorted by cell; rebuilt every step.
template <int Dim>
class Cloud {
 public:
  explicit Cloud(const Lattice<Dim>& lattice)
      : lattice_(lattice), slot_(static_cast<std::size_t>(lattice.block_count()), -1) {}

  /// Forgets all nodes; `reach`: radius of the balls about nodes [length].
  void begin(double reach);
  /// Wants the particles within reach of a node.
  void want(const Index<Dim>& node);
  /// Collects them. Bodies are numbered as they come: deformable, then rigid ones with a field of their own.
  void collect(const std::vector<Body<Dim>*>& bodies);

  const std::vector<CloudPoint<Dim>>& points() const { return points_; }
  std::size_t size() const { return points_.size(); }

  /// Calls f(point) for the particles within reach of a node.
  template <class F>
  void each_near(const Index<Dim>& node, F&& f) const {
    const Vec<Dim> centre = lattice_.position(node);
    const double limit = reach_ * reach_;
    each_cell(node, [&](std::int64_t block, int cell) {
      const int s = slot_[static_cast<std::size_t>(block)];
      if (s < 0) return;
      const std::size_t at = static_cast<std::size_t>(s) * block_nodes<Dim> + static_cast<std::size_t>(cell);
      for (std::uint32_t p = start_[at]; p < start_[at + 1]; ++p)
        if ((points_[p].x - centre).squaredNorm() <= limit) f(points_[p]);
    });
  }

  /// Particle i of a body as it is now.
  CloudPoint<Dim> point(Body<Dim>& body, std::uint32_t b, std::uint32_t i) const;

 private:
  // Calls f(block, cell in the block) for the cells that a ball about a node may cut.
  template <class F>
  void each_cell(const Index<Dim>& node, F&& f) const {
    Index<Dim> low, high, cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = std::max(0, node[d] - cells_[d]);
      high[d] = std::min(lattice_.blocks[d] * block_edge<Dim>, node[d] + cells_[d]);
    }
    const auto visit = [&] {
      Index<Dim> block;
      int local = 0;
      for (std::size_t d = Dim; d-- > 0;) {
        block[d] = cell[d] / block_edge<Dim>;
        local = local * block_edge<Dim> + cell[d] % block_edge<Dim>;
      }
      f(lattice_.block_index(block), local);
    };
    if constexpr (Dim == 3) {
      for (cell[2] = low[2]; cell[2] < high[2]; ++cell[2])
        for (cell[1] = low[1]; cell[1] < high[1]; ++cell[1])
          for (cell[0] = low[0]; cell[0] < high[0]; ++cell[0]) visit();
    } else {
      for (cell[1] = low[1]; cell[1] < high[1]; ++cell[1])
        for (cell[0] = low[0]; cell[0] < high[0]; ++cell[0]) visit();
    }
  }

  bool wanted(const Vec<Dim>& x, std::size_t& at) const;

  Lattice<Dim> lattice_;
  double reach_ = 0.0;
  Index<Dim> cells_{};
  std::vector<int> slot_;             ///< per lattice block: position among the blocks with wanted cells, or -1
  std::vector<std::int64_t> blocks_;  ///< those blocks
  std::vector<std::uint64_t> mask_;   ///< their wanted cells
  std::vector<std::uint32_t> start_;  ///< per cell of those blocks: first point
  std::vector<CloudPoint<Dim>> points_, unsorted_;
  std::vector<std::uint32_t> cell_of_;
};

}  // namespace tribo
