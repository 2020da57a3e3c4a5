// SPDX-License-Identifier: MIT
/// Splitting of stretched particles and merging of crushed ones.
#pragma once

#include "solver/state/energy_ledger.hpp"
#include "solver/state/system.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tribo {

struct CellParticle;

/// The basis of a lattice of particles: its current half axes and those of the initial domains.
template <int Dim>
struct DomainBasis {
  Mat<Dim> current;  ///< columns: current half axes [length]
  Mat<Dim> initial;  ///< columns: initial half axes [length]
};

/// Replaces the axes by shorter ones of the same lattice as long as there are any, by Lagrange's algorithm for each
/// pair of axes. Lengths are measured in cells of the given edges [length]. The volumes of the domains do not change.
template <int Dim>
DomainBasis<Dim> reduced(DomainBasis<Dim> basis, const Vec<Dim>& cell);

/// Keeps the distance of particles within the range of the shape functions, so that flowing matter does not separate
/// numerically: a particle whose domain has become longer than a number of cells splits in two along that direction,
/// and two neighbours whose common domain is small again merge.
///
/// The length of a domain is not that of its edges, which grow without limit in simple shear while neighbours stay as
/// close as before. In a homogeneous deformation particles form a lattice with the edges of the domain as a basis; the
/// edges of its reduced basis (Lagrange's algorithm) are the true distances of neighbours. The split domain is based on
/// it; the parallelepiped has the same volume and fills the lattice as well.
///
/// Splitting conserves mass, momentum, angular momentum, energy, volume and history exactly: both halves have the
/// velocity, the stress and the history of the particle. Merging conserves mass, momentum, volume and the history per
/// initial volume, and with APIC the angular momentum; the energy of the relative motion and of the difference in
/// stress is recorded as damping.
template <int Dim>
class ParticleSplitting {
 public:
  ParticleSplitting(const Model& model, System<Dim>& system, EnergyLedger& ledger);

  bool is_active() const { return spec_.has_value(); }
  /// Splits and merges the particles of all bodies as far as their domains require. Particles on which a load or a
  /// traction acts do not change. Returns whether there were any: particles are appended and removed, so they must then
  /// be sorted again. All particles must be inside the grid.
  bool apply();
  /// Number of particles that have been split and of pairs that have been merged since the start of the run.
  std::int64_t split_count() const { return split_; }
  std::int64_t merged_count() const { return merged_; }

  friend void archive(Archive& a, ParticleSplitting& splitting) {
    auto& [spec, system, ledger, next_id, split, merged] = splitting;
    a.version(1);
    a("next_id", next_id), a("split", split), a("merged", merged);
  }

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  // A particle that splits along an axis of the reduced basis.
  struct LongParticle {
    std::uint32_t particle;
    DomainBasis<Dim> basis;
    int axis;
  };

  void set_half_sizes(Body<Dim>& body);
  void split(Body<Dim>& body);
  std::vector<LongParticle> long_ones(Body<Dim>& body) const;
  bool split_once(Body<Dim>& body);
  void merge(Body<Dim>& body);
  static double largest_pair(Body<Dim>& body, std::uint32_t i);
  std::vector<CellParticle> small_ones(Body<Dim>& body) const;
  std::vector<Pair> pairs_to_merge(Body<Dim>& body) const;
  std::optional<std::uint32_t> partner_of(Body<Dim>& body, std::uint32_t i, std::span<const CellParticle> others,
                                          const std::vector<bool>& taken) const;
  void merge_pair(Body<Dim>& body, const Pair& pair);
  struct Content {
    double kinetic, stored;  // [energy]
  };
  Content content(Body<Dim>& body, std::uint32_t i) const;

  const std::optional<SplittingSpec>& spec_;
  System<Dim>& system_;
  EnergyLedger& ledger_;
  std::int64_t next_id_ = 0;
  std::int64_t split_ = 0, merged_ = 0;
};

}  // namespace tribo
