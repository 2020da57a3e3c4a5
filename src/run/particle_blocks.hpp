// SPDX-License-Identifier: MIT
/// Which particles stand in which file of a time.
#pragma once

#include "output/vtk.hpp"
#include "run/body_order.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Particles of a body in the order of a file: `order[begin]` to `order[end - 1]`, or `begin` to `end - 1` as they are
/// stored.
template <int Dim>
struct ParticleRange {
  Body<Dim>* body;
  const std::uint32_t* order;  ///< null: as they are stored
  std::size_t begin, end;
  std::size_t count() const { return end - begin; }
  std::size_t particle(std::size_t i) const { return order ? order[i] : i; }
};

/// The blocks of the particle files: the particles of each material, or of each of its bodies if they are 2 to 20, and
/// those that came later. Blocks with too many particles are divided, so that a copy of one does not need much memory.
template <int Dim>
class ParticleBlocks {
 public:
  static constexpr std::size_t usual_most = std::size_t{1} << 18U;

  /// `pieces`: the bodies of the materials in the order of their numbers; `most`: particles of a block.
  ParticleBlocks(const Model& model, std::span<Body<Dim>* const> bodies, std::span<const PieceNumbers> pieces,
                 std::size_t most = usual_most);

  const std::vector<OutputBlock>& blocks() const { return blocks_; }
  /// The particles of each block; valid until the particles are sorted again.
  const std::vector<ParticleRange<Dim>>& ranges() const { return ranges_; }

 private:
  void add(const OutputBlock& block, const ParticleRange<Dim>& range, std::size_t most);

  std::vector<BodyOrder> orders_;
  std::vector<OutputBlock> blocks_;
  std::vector<ParticleRange<Dim>> ranges_;
};

}  // namespace tribo
