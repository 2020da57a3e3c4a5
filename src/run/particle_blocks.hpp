// SPDX-License-Identifier: MIT
/// Which particles stand in which file of a time.
#pragma once

#include "model/output_fields.hpp"
#include "output/vtk.hpp"
#include "run/body_order.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Particles of a body in the order of a file.
template <int Dim>
struct ParticleRange : ParticleOrder {
  Body<Dim>* body;
};

/// The blocks of the particle files: the particles of each material, or of each of its bodies if they are 2 to 20, and
/// those that came later. Blocks with too many particles are divided, so that a copy of one does not need much memory.
/// A block consists of one range of particles, or of several if the bodies of its material touch each other.
template <int Dim>
class ParticleBlocks {
 public:
  static constexpr std::size_t usual_most = std::size_t{1} << 18U;

  /// `pieces`: the bodies of the materials in the order of their numbers; `most`: particles of a block.
  ParticleBlocks(const Model& model, std::span<Body<Dim>* const> bodies, std::span<const PieceNumbers> pieces,
                 std::size_t most = usual_most);

  const std::vector<OutputBlock>& blocks() const { return blocks_; }
  /// The particles of all blocks, one after the other; valid until the particles are sorted again.
  const std::vector<ParticleRange<Dim>>& ranges() const { return ranges_; }
  /// The particles of a block.
  std::span<const ParticleRange<Dim>> ranges(std::size_t block) const {
    const std::size_t end = block + 1 < first_.size() ? first_[block + 1] : ranges_.size();
    return std::span(ranges_).subspan(first_[block], end - first_[block]);
  }
  /// Number of particles of a block.
  std::size_t count(std::size_t block) const {
    std::size_t sum = 0;
    for (const auto& range : ranges(block)) sum += range.count();
    return sum;
  }

 private:
  static constexpr std::size_t most_bodies = 20;  // a folder of thousands of small files is of no use
  using Ranges = std::vector<ParticleRange<Dim>>;

  void add_material(const Model& model, Body<Dim>& body, std::span<const PieceNumbers> pieces, std::size_t most);
  void add_bodies(const Model& model, std::span<Body<Dim>* const> bodies, std::size_t most);
  void add(const OutputBlock& block, const ParticleRange<Dim>& range, std::size_t most);
  void add_parts(const OutputBlock& block, const std::vector<Ranges>& parts);

  std::vector<BodyOrder> orders_;
  std::vector<OutputBlock> blocks_;
  std::vector<std::size_t> first_;  // range of each block
  std::vector<ParticleRange<Dim>> ranges_;
};

}  // namespace tribo
